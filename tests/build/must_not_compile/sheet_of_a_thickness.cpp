// SPDX-License-Identifier: MIT
// expect: the layers of a sheet are counted
#include "hmps/terms/sheet_stabiliser.hpp"

int main() { return static_cast<int>(hmps::sheet_stabiliser(4.8e-3 / 1.2e-3, 2e6, 7e3).modulus); }
