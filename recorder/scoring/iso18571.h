// ISO/TS 18571 rating of two curves on one uniform grid: corridor Z, phase E_P, magnitude E_M
// (dynamic time warping), slope E_S and R = w_Z Z + w_P E_P + w_M E_M + w_S E_S [iso18571].
//
// The corridor uses the curves as they are; magnitude and slope use the pieces aligned by the
// phase.
#pragma once

#include <optional>
#include <string>

#include "recorder/channel.h"

namespace crosswalk::recording {

struct Iso18571Parameters {
  double K_Z = 2, K_P = 1, K_M = 1, K_S = 1;          ///< exponents
  double a_0 = 0.05, b_0 = 0.50;                      ///< corridor half-widths, share of max|x|
  double eps_P = 0.2;                                 ///< largest shift, share of the samples
  double eps_M = 0.5, eps_S = 2.0;                    ///< errors that score zero
  double w_Z = 0.4, w_P = 0.2, w_M = 0.2, w_S = 0.2;  ///< weights
  double w_dtw = 0.1;                                 ///< warping band, share of the aligned length
};

struct Iso18571Result {
  double R = 0, Z = 0, EP = 0, EM = 0, ES = 0;
  double rho_E = 0;                      ///< correlation of the best alignment
  int n_eps = 0;                         ///< its shift in samples
  int ref_start = 0, sim_start = 0;      ///< first samples of the aligned pieces
  std::optional<double> e_mag, e_slope;  ///< absent where the reference part is identically zero
  std::string grade;                     ///< excellent, good, fair, poor
};

/// Both series must stand on the same uniform times (align_grids); at least 9 samples.
Iso18571Result iso18571(const Series& reference, const Series& simulation,
                        const Iso18571Parameters& parameters);

/// Puts two series onto one uniform grid: kept when their times agree and are uniform, else
/// resampled over their common time with the smaller median step. Throws no_overlap.
void align_grids(Series& reference, Series& simulation);

}  // namespace crosswalk::recording
