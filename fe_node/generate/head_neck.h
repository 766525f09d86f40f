// The generated head and neck: from body measures to a keyword deck.
//
// Model frame N: origin at the centre of the T1 body, x forward, y left, z up, head upright with
// the Frankfurt plane horizontal. The multibody C7/T1 joint is Landmarks::c7_t1 of this frame, the
// centre of the disc between C7 and T1. Free muscle ends lie on three rigid blocks: torso (with T2
// and T3) and the two clavicles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fe_node/deck/deck.h"
#include "fe_node/generate/head_shape.h"
#include "fe_node/generate/mass_report.h"
#include "fe_node/generate/part_spec.h"
#include "fe_node/generate/spine.h"
#include "fe_node/generate/tissues.h"

namespace crosswalk {
class ConfigTable;
}

namespace crosswalk::fe::generate {

enum class Fidelity { Coarse, Medium, Fine };

/// Where the neck has to end and the head's mass to lie, from the neck's base (C7/T1 joint), m.
struct NeckFit {
  Vec3 condyles = Vec3::Zero();
  Vec3 head_centre = Vec3::Zero();
};

struct HeadNeckSpec {
  Fidelity fidelity = Fidelity::Coarse;
  HeadMeasures head;
  double neck_circumference = 0.390;  ///< m
  double stature = 1.753;             ///< m
  std::optional<NeckFit> fit;         ///< none: neck and head stand as stature has them
  MassTarget mass;
  double brain_bulk = kBrainBulk;   ///< of brain, cord and CSF, Pa
  double muscle_area_factor = 1.2;  ///< on the female baseline areas
  double activation = 0;            ///< of all muscles, 0 to 1
  UnitSystem units = UnitSystem::MmTonneS;
};

/// Points of the model in N, m.
struct Landmarks {
  Vec3 c7_t1 = Vec3::Zero();        ///< centre of the C7-T1 disc = multibody C7/T1 joint
  Vec3 condyles = Vec3::Zero();     ///< occipital condyle axis = multibody OC joint
  Vec3 tragion = Vec3::Zero();      ///< origin of the Frankfurt frame (axes parallel to N)
  Vec3 head_centre = Vec3::Zero();  ///< mass centre of the head
  Vec3 clavicle_left = Vec3::Zero(), clavicle_right = Vec3::Zero();  ///< block centres
};

struct HeadNeck {
  ModelDraft draft;
  Spine spine;
  Landmarks landmarks;
  MassReport masses;
};

/// The model in SI. Throws UserError when a measure is outside what the shapes were checked for.
HeadNeck build_head_neck(const HeadNeckSpec& spec);
/// The deck alone.
Deck generate_head_neck(const HeadNeckSpec& spec);

}  // namespace crosswalk::fe::generate
