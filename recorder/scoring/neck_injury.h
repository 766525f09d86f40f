// Neck injury criteria Nij and Nkm from upper neck loads with SAE J211 signs: F_z > 0 tension,
// M_y > 0 flexion, F_x > 0 head pushed rearward relative to the chest. Forces N, moments N m.
//
// Nij = F_z/F_zc + M/M_yc, Nkm = |F_x|/F_c + M/M_c, each with the critical value of the active
// direction; M = M_y - e F_x is the moment at the occipital condyles.
#pragma once

#include <vector>

namespace crosswalk::recording {

struct NeckParameters {
  double e_m = 0.01778;  ///< m, load cell above the condyles (Hybrid III); 0 when M is at the joint
  double Fzt = 6806, Fzc = 6160, Mf = 310, Me = 135;  ///< Nij [eppinger2000], Hybrid III 50th
  double nkm_F = 845, nkm_Mf = 88.1, nkm_Me = 47.5;   ///< Nkm [schmitt2001]
};

struct NeckLoads {
  std::vector<double> t, fx, fz, my;
};

struct NeckResult {
  double Nij = 0, NTF = 0, NTE = 0, NCF = 0, NCE = 0;
  double Nkm = 0, NFA = 0, NEA = 0, NFP = 0, NEP = 0;  ///< A anterior (F_x > 0), P posterior
};

NeckResult neck_injury(const NeckLoads& loads, const NeckParameters& parameters);

}  // namespace crosswalk::recording
