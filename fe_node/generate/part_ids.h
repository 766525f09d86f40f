// Part numbers of the generated deck; the names in outputs come with them (tissues.h).
#pragma once

namespace crosswalk::fe::generate::part {

inline constexpr int kScalp = 1000;
inline constexpr int kOuterTable = 1010;
inline constexpr int kDiploe = 1011;  ///< bricks of the whole skull, the tables on their faces
inline constexpr int kInnerTable = 1012;
inline constexpr int kDura = 1020;
inline constexpr int kCsf = 1021;
inline constexpr int kPia = 1022;
inline constexpr int kCerebrumLeft = 1030;
inline constexpr int kCerebrumRight = 1031;
inline constexpr int kCerebellumLeft = 1032;
inline constexpr int kCerebellumRight = 1033;
inline constexpr int kBrainstem = 1034;
inline constexpr int kCord = 1036;  ///< in the foramen magnum
inline constexpr int kFalx = 1040;
inline constexpr int kTentorium = 1041;
inline constexpr int kFace = 1050;
inline constexpr int kFirstVertebra = 2010;  ///< C1; + 10 per level, C7 2070, T1 2080
inline constexpr int kFirstDisc = 3020;      ///< below C2; + 10 per level, T2 3090
inline constexpr int kFirstLigament = 4000;
inline constexpr int kFacet = 4080;  ///< and stops of the upper joints
inline constexpr int kFirstJointStrut = 4095;
inline constexpr int kFirstFibre = 4100;  ///< of the annulus; + 10 per disc, + layer
inline constexpr int kFirstNucleus = 4190;
inline constexpr int kFirstMuscle = 5000;
inline constexpr int kFlesh = 6000;
inline constexpr int kNeckSkin = 6001;  ///< that of the head is in the scalp
inline constexpr int kBlockTorsoUp = 7001;
inline constexpr int kBlockClavicleLeft = 7002;
inline constexpr int kBlockClavicleRight = 7003;
inline constexpr int kWindshield = 8001;
inline constexpr int kWindshieldBead = 8002;
inline constexpr int kBlockBuck = 8003;

}  // namespace crosswalk::fe::generate::part
