# SPDX-License-Identifier: GPL-2.0-or-later
"""Drained plane strain compression of Toyoura sand (d50 0.16 mm), bedding normal to the major stress, after the digitised
figures of a third party. Stress ratio and volume strain (%, dilation negative) over axial strain (%).

49 kPa: Tatsuoka, Sakamoto, Kawamura and Fukushima 1986, Soils and Foundations 26(1), Fig. 16(a), void ratio 0.716.
98 kPa: Lam and Tatsuoka 1988, Soils and Foundations 28(1), Fig. 9, height over width 1.9, void ratio 0.656. Its volume
strain below 1.6 % is uncertain by 0.3 %, its stiffness below 0.8 % was not resolved.
Reproducibility of the laboratory: about 1.5 degrees of friction angle.
"""
CURVES = {
    49: {"ratio": [(0, 1.00), (0.17, 2.72), (0.26, 3.00), (0.60, 4.00), (1.01, 5.00), (1.30, 5.50), (1.71, 6.00),
                   (2.05, 6.32), (2.62, 6.00), (3.02, 5.50), (3.22, 5.00), (3.48, 4.50), (3.95, 4.25), (5.00, 4.18),
                   (7.00, 4.15), (9.00, 4.20), (11.90, 4.22)],
         "volume": [(0, 0), (1.00, 0.00), (1.98, -0.55), (3.06, -1.28), (3.90, -1.54), (6.30, -1.76), (8.40, -1.87),
                    (11.90, -2.04)]},
    98: {"ratio": [(0, 1.00), (0.80, 4.23), (1.19, 5.00), (1.39, 5.77), (1.90, 6.45), (2.34, 6.49), (3.47, 5.08),
                   (4.10, 4.80), (4.64, 4.82), (5.50, 4.98), (6.46, 5.05), (7.21, 4.97), (8.02, 4.74), (8.92, 4.55),
                   (10.11, 4.59), (11.06, 4.62)],
         "volume": [(0, 0), (1.60, -0.30), (1.78, -0.44), (1.96, -0.58), (2.32, -0.86), (2.67, -1.16), (3.02, -1.46),
                    (3.25, -1.61), (6.19, -2.16), (7.21, -2.33), (8.31, -2.46), (9.21, -2.54), (10.10, -2.60),
                    (11.05, -2.63)]},
}
