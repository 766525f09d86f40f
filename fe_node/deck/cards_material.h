// Cards of every material law, for reading and writing (card_io.h).
#pragma once

#include "fe_node/deck/card_io.h"
#include "fe_node/deck/material_records.h"

namespace crosswalk::fe::mat {

void cards(CardIo& io, Material& material, Elastic& law);
void cards(CardIo& io, Material& material, PlasticKinematic& law);
void cards(CardIo& io, Material& material, Viscoelastic& law);
void cards(CardIo& io, Material& material, Null& law);
void cards(CardIo& io, Material& material, Rigid& law);
void cards(CardIo& io, Material& material, PiecewiseLinearPlasticity& law);
void cards(CardIo& io, Material& material, MooneyRivlin& law);
void cards(CardIo& io, Material& material, LaminatedGlass& law);
void cards(CardIo& io, Material& material, Fabric& law);
void cards(CardIo& io, Material& material, LowDensityFoam& law);
void cards(CardIo& io, Material& material, KelvinMaxwell& law);
void cards(CardIo& io, Material& material, GeneralViscoelastic& law);
void cards(CardIo& io, Material& material, HyperelasticRubber& law);
void cards(CardIo& io, Material& material, OgdenRubber& law);
void cards(CardIo& io, Material& material, FuChangFoam& law);
void cards(CardIo& io, Material& material, SoftTissue& law);
void cards(CardIo& io, Material& material, PlasticityCompressionTension& law);
void cards(CardIo& io, Material& material, HillFoam& law);
void cards(CardIo& io, Material& material, SimplifiedRubber& law);
void cards(CardIo& io, Material& material, CableDiscreteBeam& law);
void cards(CardIo& io, Material& material, Spotweld& law);
void cards(CardIo& io, Material& material, Nonlinear6DofBeam& law);
void cards(CardIo& io, Material& material, Nonlinear1DofBeam& law);
void cards(CardIo& io, Material& material, Muscle& law);
void cards(CardIo& io, Material& material, Seatbelt& law);
void cards(CardIo& io, Material& material, SpringElastic& law);
void cards(CardIo& io, Material& material, DamperViscous& law);
void cards(CardIo& io, Material& material, SpringElastoplastic& law);
void cards(CardIo& io, Material& material, SpringNonlinearElastic& law);
void cards(CardIo& io, Material& material, DamperNonlinearViscous& law);
void cards(CardIo& io, Material& material, SpringGeneralNonlinear& law);
void cards(CardIo& io, Material& material, SpringMaxwell& law);
void cards(CardIo& io, Material& material, SpringInelastic& law);
void cards(CardIo& io, Material& material, SpringMuscle& law);
void cards(CardIo& io, Material& material, Unsupported& law);

}  // namespace crosswalk::fe::mat
