// SPDX-License-Identifier: GPL-2.0-or-later
// The engine's contact_models.h includes this list; the package does not ship it. Only models named here can be
// combined with this project's. No include guard: it is read once per macro, on purpose.
#include "normal_model_hooke.h"
#include "normal_model_hooke_stiffness.h"
#include "normal_model_hooke_hysteresis.h"
#include "normal_model_hertz.h"
#include "normal_model_hertz_stiffness.h"
#include "normal_model_edinburgh.h"
#include "normal_model_edinburgh_stiffness.h"
#include "normal_model_luding.h"
#include "normal_model_thornton_ning.h"
#include "dem/contact/normal_hooke_radii.hpp"
