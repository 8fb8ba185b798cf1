// SPDX-License-Identifier: MIT
#pragma once

// Contact between organs: the class MetaballContact and its member functions.
#include "hmps/contact/detail/contact_checkpoint.hpp"
#include "hmps/contact/detail/contact_declaration.hpp"
#include "hmps/contact/detail/contact_evaluate.hpp"
#include "hmps/contact/detail/contact_forces.hpp"
#include "hmps/contact/detail/contact_overlaps.hpp"
