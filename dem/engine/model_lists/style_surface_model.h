// SPDX-License-Identifier: GPL-2.0-or-later
// The engine's contact_models.h includes this list; the package does not ship it. Only models named here can be
// combined with this project's. No include guard: it is read once per macro, on purpose.
#include "surface_model_default.h"
#include "surface_model_multicontact.h"
