// SPDX-License-Identifier: MIT
// expect: shear_wave_modulus takes the shear modulus in Pa, not the law
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"

int main() { (void)hmps::shear_wave_modulus(hmps::MooneyRivlin<>::from_young(20e3, 1e6)); }
