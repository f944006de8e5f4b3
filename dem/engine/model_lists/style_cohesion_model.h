// SPDX-License-Identifier: GPL-2.0-or-later
// The engine's contact_models.h includes this list; the package does not ship it. Only models named here can be
// combined with this project's. No include guard: it is read once per macro, on purpose.
#include "cohesion_model_sjkr.h"
#include "cohesion_model_sjkr2.h"
#include "cohesion_model_easo_capillary_viscous.h"
#include "cohesion_model_washino_capillary_viscous.h"
