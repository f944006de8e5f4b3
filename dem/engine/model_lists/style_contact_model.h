// SPDX-License-Identifier: GPL-2.0-or-later
// The engine's granular_styles.h includes this list of compiled combinations; this project registers its own in
// dem/contact/registration.cpp, so it stays empty.
