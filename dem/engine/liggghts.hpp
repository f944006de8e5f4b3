// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The engine's headers in the one order that compiles (global_properties.h and fix_insert_stream.h must come
// before granular_styles.h). Only dem/ may include this file. The engine is the distribution's own library;
// its optional shape models are not compiled in there, so their macros must not be defined here.
// clang-format off
#include <mpi.h>

#include <lammps.h>

#include <atom.h>
#include <atom_vec.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <fix.h>
#include <fix_contact_history.h>
#include <fix_property_global.h>
#include <force.h>
#include <global_properties.h>
#include <fix_insert_stream.h>
#include <granular_styles.h>
#include <input.h>
#include <integrate.h>
#include <memory.h>
#include <modify.h>
#include <neighbor.h>
#include <output.h>
#include <pair_gran.h>
#include <pair_gran_proxy.h>
#include <timer.h>
#include <update.h>
#include <variable.h>
// clang-format on
