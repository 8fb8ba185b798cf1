// SPDX-License-Identifier: MIT
// expect: a formula is given integers, to which its results would be rounded
#include "hmps/terms/shear_wave_modulus.hpp"

int main() { return hmps::shear_wave_modulus(7000); }
