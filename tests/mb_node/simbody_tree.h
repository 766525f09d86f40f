// A tree of rigid bodies moved by Simbody. Plain types: Simbody's headers are not C++20, so this is
// the one unit built as C++17 and it knows nothing of ours.
#pragma once

#include <array>
#include <vector>

namespace crosswalk::oracle {

enum class Joint { Free, Ball, PinX, PinY, PinZ, UniversalXY, SliderY };

/// All body frames parallel to the world at the start.
struct Body {
  int parent = -1;
  Joint joint = Joint::Free;
  double mass = 0;
  std::array<double, 3> moments{};       ///< principal, about the centre of mass
  std::array<double, 3> com{};           ///< at the start
  std::array<double, 3> joint_centre{};  ///< at the start
  std::array<double, 3> rate{};          ///< relative spin at the start; the root's own spin
  std::array<double, 3> velocity{};      ///< of the root's centre of mass
};

/// Centres of mass after free flight, Runge-Kutta-Merson at relative accuracy 1e-9.
std::vector<std::array<double, 3>> free_flight(const std::vector<Body>& bodies, double duration);

}  // namespace crosswalk::oracle
