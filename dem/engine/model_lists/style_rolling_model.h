// SPDX-License-Identifier: GPL-2.0-or-later
// The engine's contact_models.h includes this list; the package does not ship it. Only models named here can be
// combined with this project's. No include guard: it is read once per macro, on purpose.
#include "rolling_model_cdt.h"
#include "rolling_model_epsd.h"
#include "rolling_model_epsd2.h"
#include "rolling_model_epsd3.h"
#include "rolling_model_luding.h"
#include "dem/contact/rolling_li_chu.hpp"
