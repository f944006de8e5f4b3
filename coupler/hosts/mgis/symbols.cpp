// SPDX-License-Identifier: GPL-2.0-or-later
// The names by which a host finds the behaviour PolargrainCell and what it is, as MGIS asks for them (interface of
// MFront's generic behaviours, version 1). Types: 0 scalar, 2 vector, 3 tensor, 5 array.
#include "coupler/hosts/mgis/cell_behaviour.hpp"

namespace {

using polargrain::coupler::mgis::CellBehaviour;
using polargrain::coupler::mgis::DataView;
using polargrain::coupler::mgis::Hypothesis;

/// An array of scalars: kind, number of extents, extents of seven bits.
int type_of_state() {
  int type = 5;
  const std::vector<int>& shape = CellBehaviour::of_library().state_shape();
  type |= static_cast<int>(shape.size()) << 3;
  for (std::size_t k = 0; k < shape.size(); ++k) type |= shape[k] << (6 + 7 * k);
  return type;
}

}  // namespace

// All that follows, and nothing else of the library, is seen by hosts.
#pragma GCC visibility push(default)
extern "C" {

const char* PolargrainCell_mfront_ept = "PolargrainCell";
const char* PolargrainCell_tfel_version = "";  // not made by TFEL
const char* PolargrainCell_unit_system = "SI";
const char* PolargrainCell_src = "polargrain: a periodic box of grains";
const char* PolargrainCell_author = "polargrain developers";
const char* PolargrainCell_date = "";
const char* PolargrainCell_validator = "";
const char* PolargrainCell_build_id = "polargrain " POLARGRAIN_VERSION;
const char* PolargrainCell_mfront_interface = "Generic";

// One line a number: the kind of the behaviour, and how many variables of each kind it has.
#define POLARGRAIN_NUMBER(name, value) unsigned short PolargrainCell_##name = value;

POLARGRAIN_NUMBER(mfront_mkt, 1)  // a behaviour
POLARGRAIN_NUMBER(api_version, 1)
POLARGRAIN_NUMBER(BehaviourType, 0)       // general
POLARGRAIN_NUMBER(BehaviourKinematic, 0)  // not one of the usual kinds
POLARGRAIN_NUMBER(SymmetryType, 0)        // no axes that the host must turn to
POLARGRAIN_NUMBER(ElasticSymmetryType, 0)
POLARGRAIN_NUMBER(requiresStiffnessTensor, 0)
POLARGRAIN_NUMBER(requiresThermalExpansionCoefficientTensor, 0)
POLARGRAIN_NUMBER(ComputesInternalEnergy, 0)
POLARGRAIN_NUMBER(ComputesDissipatedEnergy, 0)
POLARGRAIN_NUMBER(TemperatureRemovedFromExternalStateVariables, 0)  // it has no temperature
POLARGRAIN_NUMBER(nMaterialProperties, 0)
POLARGRAIN_NUMBER(nExternalStateVariables, 0)
POLARGRAIN_NUMBER(nParameters, 0)
POLARGRAIN_NUMBER(nPostProcessings, 0)
POLARGRAIN_NUMBER(nGradients, 2)
POLARGRAIN_NUMBER(nThermodynamicForces, 2)
POLARGRAIN_NUMBER(nTangentOperatorBlocks, 8)  // names: two a block
POLARGRAIN_NUMBER(nInternalStateVariables, 1)
POLARGRAIN_NUMBER(nInitializeFunctions, 1)
POLARGRAIN_NUMBER(nInitializeFunction_AtRest_Inputs, 0)

const char* PolargrainCell_Gradients[2] = {"TotalStrain", "WrynessTensor"};
const char* PolargrainCell_ThermodynamicForces[2] = {"Stress", "CoupleStressTensor"};
const char* PolargrainCell_TangentOperatorBlocks[8] = {
    "Stress",      "TotalStrain",        "Stress",       "WrynessTensor", "CoupleStressTensor",
    "TotalStrain", "CoupleStressTensor", "WrynessTensor"};
const char* PolargrainCell_InternalStateVariables[1] = {"CellState"};
const char* PolargrainCell_InitializeFunctions[1] = {"AtRest"};

// In plane strain rotations are about one axis: wryness and couple stress are vectors.
int PolargrainCell_PlaneStrain_GradientsTypes[2] = {3, 2};
int PolargrainCell_PlaneStrain_ThermodynamicForcesTypes[2] = {3, 2};
int PolargrainCell_Tridimensional_GradientsTypes[2] = {3, 3};
int PolargrainCell_Tridimensional_ThermodynamicForcesTypes[2] = {3, 3};
int PolargrainCell_ParametersTypes[1] = {0};
int PolargrainCell_InitializeFunction_AtRest_InputsTypes[1] = {0};
// Set when the library is loaded: it is for the packing of the cell to say how much its grains have to remember.
int PolargrainCell_InternalStateVariablesTypes[1] = {type_of_state()};

int PolargrainCell_PlaneStrain(DataView* data) {
  return CellBehaviour::of_library().integrate(*data, Hypothesis::plane_strain);
}
int PolargrainCell_Tridimensional(DataView* data) {
  return CellBehaviour::of_library().integrate(*data, Hypothesis::space);
}
int PolargrainCell_PlaneStrain_InitializeFunction_AtRest(DataView* data, const double*) {
  return CellBehaviour::of_library().put_at_rest(*data, Hypothesis::plane_strain);
}
int PolargrainCell_Tridimensional_InitializeFunction_AtRest(DataView* data, const double*) {
  return CellBehaviour::of_library().put_at_rest(*data, Hypothesis::space);
}
}
#pragma GCC visibility pop
