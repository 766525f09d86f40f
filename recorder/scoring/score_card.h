// Every injury metric that the given signals allow, in one pass: the card of one head.
//
// Channel classes when filtering: linear acceleration CFC 1000 per component, angular velocity CFC
// 60 with angular acceleration as its derivative, neck forces CFC 1000, neck moment CFC 600 [SAE
// J211-1].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recorder/scoring/brain_injury.h"
#include "recorder/scoring/head_injury.h"
#include "recorder/scoring/neck_injury.h"
#include "recorder/scoring/risk.h"
#include "recorder/signal.h"

namespace crosswalk::recording {

/// Head signals in head-fixed SAE J211 axes and upper neck loads; whatever is absent is not rated.
struct HeadSignals {
  std::optional<VectorSeries> acceleration;          ///< m/s2, of the head COG
  std::optional<VectorSeries> angular_velocity;      ///< rad/s
  std::optional<VectorSeries> angular_acceleration;  ///< rad/s2
  std::optional<NeckLoads> neck;
  NeckParameters neck_parameters;
  std::vector<std::string> notes;  ///< what filtering did besides filtering
};

/// Applies the channel classes above (irregular signals are resampled at their median step first).
HeadSignals filtered(const HeadSignals& signals, FilterForm form = FilterForm::Iso6487);

struct LinearScores {
  double peak_g = 0;
  WindowMaximum HIC15, HIC36;
  std::optional<WindowMaximum> clip_single;  ///< g; absent for a record under 3 ms
  std::optional<double> clip_cumulative;     ///< g
  double GSI = 0;
};

struct RotationScores {
  double peak_w = 0, peak_alpha = 0;  ///< rad/s, rad/s2, of the resultants
  Bric BrIC;
  double UBrIC_p2p = 0, UBrIC_max = 0;
  Damage DAMAGE;
  double RIC15 = 0, RIC36 = 0;
};

/// Metrics that need linear and angular signals on one time base.
struct CombinedScores {
  double GAMBIT_2 = 0, GAMBIT_2p5 = 0, HIP_W = 0, PRHIC15 = 0, PRHIC36 = 0, KLC = 0, HARM = 0;
};

struct ScoreCard {
  std::optional<LinearScores> linear;
  std::optional<RotationScores> rotation;
  std::optional<CombinedScores> combined;
  std::optional<NeckResult> neck;
  std::vector<RiskFamily> risks;
  std::vector<std::string> notes;  ///< what was derived or resampled on the way
};

ScoreCard score_card(const HeadSignals& signals);

}  // namespace crosswalk::recording
