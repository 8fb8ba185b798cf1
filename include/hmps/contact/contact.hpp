// SPDX-License-Identifier: MIT
#pragma once

// Contact between organs: the class MetaballContact and its member functions.
#include "hmps/contact/contact_checkpoint.hpp"
#include "hmps/contact/contact_declaration.hpp"
#include "hmps/contact/contact_evaluate.hpp"
#include "hmps/contact/contact_forces.hpp"
#include "hmps/contact/contact_overlaps.hpp"
