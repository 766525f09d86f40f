// The generated neck for component tests: what of it takes part, and how its levels turn.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/spine.h"
#include "fe_node/validate/deck_case.h"

namespace crosswalk::fe::validate {

generate::HeadNeck reference_neck(generate::Fidelity fidelity);

/// Spine with discs, ligaments and joints; the occiput alone stands for the head.
generate::ModelDraft ligamentous_spine(const generate::HeadNeck& whole);
/// The whole neck under a head that is one rigid body.
generate::ModelDraft neck_with_rigid_head(const generate::HeadNeck& whole);

/// Rigid part of a level, C0 to T1.
int part_of_level(generate::Level level);
/// Index of a rigid part in the run's bodies.
int body_of_part(const DeckRun& run, const generate::ModelDraft& draft, int part);

/// The levels between C0 and T1: name of the joint below each body.
inline constexpr int kNeckLevels = 8;
extern const std::array<const char*, kNeckLevels> kLevelNames;

/// Bodies C0 to T1 of a run.
std::vector<int> spine_bodies(const DeckRun& run, const generate::ModelDraft& draft);
/// Turning of each level about a global axis of the undeformed draft (0 x, 1 y, 2 z), rad: of z in
/// the sagittal and the frontal plane, of x in the transverse plane. Coupled turning leaves it
/// alone.
std::vector<double> level_angles(const State& state, const std::vector<int>& bodies, int axis);

/// What bears a load in the neck.
enum class Bearer { Disc, Ligament, Facet, Strut, Muscle, Flesh };
inline constexpr int kBearers = 6;
const char* name(Bearer bearer);
/// Energy in each kind of part, J, at the last force evaluation.
std::array<double, kBearers> energy_by_bearer(const DeckRun& run);

}  // namespace crosswalk::fe::validate
