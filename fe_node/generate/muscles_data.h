// The neck muscles: strands, ends and areas. Areas are sums over the strands of a muscle of the
// VIVA+ female baseline, mm2 per side [vivaplus2022]; the choice of strands follows its routing.
#pragma once

#include <array>
#include <span>

namespace crosswalk::fe::generate {

/// Where a strand ends. Skull points in the Frankfurt frame of the reference head; girdle points in
/// N.
enum class Site {
  MastoidTip,
  NuchalLateral,
  NuchalMedial,
  NuchalInferior,
  Basiocciput,
  JugularProcess,
  Hyoid,
  Spinous,     ///< level
  Transverse,  ///< level
  Articular,   ///< level
  Front,       ///< level
  SternalNotch,
  ClavicleMedial,
  ClavicleLateral,
  Acromion,
  ScapulaSuperior,
  ScapulaMedial,
  Rib1,
  Rib2,
  Rib3,
  RibsBack
};

struct StrandEnd {
  Site site;
  int level = -1;  ///< 1..7 cervical, 8.. thoracic
};

struct Strand {
  const char* muscle;
  double area_mm2;  ///< of this strand, one side
  StrandEnd upper, lower;
  bool follows_spine = false;  ///< held by the vertebrae between its ends
};

/// All strands of one side.
std::span<const Strand> neck_strands();

}  // namespace crosswalk::fe::generate
