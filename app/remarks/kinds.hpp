// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "app/remarks/scene.hpp"

// The kinds of remarks: each looks at a scene and adds its remarks. The head of its file in
// kinds/ says where each looks.
namespace polargrain::app {

void loads_at_start(const Scene& scene, Remarks& remarks);
void weight_in_boxes(const Scene& scene, Remarks& remarks);
void weight_at_once(const Scene& scene, Remarks& remarks);
void loads_twice(const Scene& scene, Remarks& remarks);
void load_on_held(const Scene& scene, Remarks& remarks);
void node_forces(const Scene& scene, Remarks& remarks);
void plain_loads(const Scene& scene, Remarks& remarks);
void tension(const Scene& scene, Remarks& remarks);
void ground_stress(const Scene& scene, Remarks& remarks);
void weight(const Scene& scene, Remarks& remarks);
void free_sides(const Scene& scene, Remarks& remarks);
void structures(const Scene& scene, Remarks& remarks);
void weight_of_parts(const Scene& scene, Remarks& remarks);
void loads_of_stages(const Scene& scene, Remarks& remarks);
void sums_of_stages(const Scene& scene, Remarks& remarks);
void placed_stress(const Scene& scene, Remarks& remarks);
void densities(const Scene& scene, Remarks& remarks);
void motions(const Scene& scene, Remarks& remarks);
void length_of_pulses(const Scene& scene, Remarks& remarks);
void quiet_sides(const Scene& scene, Remarks& remarks);
void movement(const Scene& scene, Remarks& remarks);
void pulled_apart(const Scene& scene, Remarks& remarks);
void times_of_loads(const Scene& scene, Remarks& remarks);
void idle_steps(const Scene& scene, Remarks& remarks);
void growing_steps(const Scene& scene, Remarks& remarks);
void missed_turns(const Scene& scene, Remarks& remarks);
void steps_of_strain(const Scene& scene, Remarks& remarks);
void internal_length(const Scene& scene, Remarks& remarks);
void plastic_length(const Scene& scene, Remarks& remarks);
void few_grains(const Scene& scene, Remarks& remarks);
void softness(const Scene& scene, Remarks& remarks);
void size_of_grains(const Scene& scene, Remarks& remarks);
void unread_properties(const Scene& scene, Remarks& remarks);
void contact_numbers(const Scene& scene, Remarks& remarks);
void neighbours(const Scene& scene, Remarks& remarks);
void tolerances(const Scene& scene, Remarks& remarks);
void softening_cauchy(const Scene& scene, Remarks& remarks);
void stiffness_of_laws(const Scene& scene, Remarks& remarks);
void strength_of_laws(const Scene& scene, Remarks& remarks);
void moduli(const Scene& scene, Remarks& remarks);
void monitors(const Scene& scene, Remarks& remarks);
void measures(const Scene& scene, Remarks& remarks);
void formulas(const Scene& scene, Remarks& remarks);
void places_of_monitors(const Scene& scene, Remarks& remarks);
void ends_of_profiles(const Scene& scene, Remarks& remarks);
void ends_of_regions(const Scene& scene, Remarks& remarks);
void parted_curves(const Scene& scene, Remarks& remarks);
void carried_along(const Scene& scene, Remarks& remarks);
void narrow_plates(const Scene& scene, Remarks& remarks);
void held_sides(const Scene& scene, Remarks& remarks);
void shape_of_elements(const Scene& scene, Remarks& remarks);
void skew_locking(const Scene& scene, Remarks& remarks);
void open_seams(const Scene& scene, Remarks& remarks);
void hanging_nodes(const Scene& scene, Remarks& remarks);
void pore_water(const Scene& scene, Remarks& remarks);
void drains_dug_away(const Scene& scene, Remarks& remarks);
void loads_behind_walls(const Scene& scene, Remarks& remarks);
void polygons_of_cylinders(const Scene& scene, Remarks& remarks);
void end_of_run_before(const Scene& scene, Remarks& remarks);
void pressure_of_run_before(const Scene& scene, Remarks& remarks);
void output(const Scene& scene, Remarks& remarks);
void cost(const Scene& scene, Remarks& remarks);
/// Adds to the other kinds: only where they have no remark on time zero.
void balance_at_start(const Scene& scene, Remarks& remarks);

}  // namespace polargrain::app
