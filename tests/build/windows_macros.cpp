// SPDX-License-Identifier: MIT
// The headers beside the macros that <windows.h> leaves behind, NOMINMAX being defined: none of these names may be one
// of ours. It only has to compile.
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nanoflann.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <unordered_map>

#define near
#define far
#define small char
#define interface struct
#define IN
#define OUT
#define OPTIONAL
#define ERROR 0
#define DELETE (0x00010000L)
#define TRUE 1
#define FALSE 0
#define NO_ERROR 0L
#define pascal
#define cdecl
#define CALLBACK

#include "hmps/hmps.hpp"

int main() {}
