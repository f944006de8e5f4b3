// SPDX-License-Identifier: GPL-2.0-or-later
// The engine's contact_models.h includes this list; the package does not ship it. Only models named here can be
// combined with this project's. No include guard: it is read once per macro, on purpose.
#include "tangential_model_no_history.h"
#include "tangential_model_history.h"
#include "tangential_model_luding_tn.h"
#include "dem/contact/tangential_li_chu.hpp"
