// The messages of a small coupled run with known motion, for tests of everything behind the bus.
//
// Buck: constant 11 m/s along +y from window 0. Head: at rest until 10 ms, then accelerated along
// +y by 300 m/s2 (bell shaped) while turning about z at 20 rad/s. Car-pedestrian contact from 2 ms
// on, head contact from 12 ms. 20 ms in windows of 20 us.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace crosswalk::recording {

struct RawMessage {
  std::string channel;
  std::vector<std::byte> data;
};

struct SyntheticRun {
  static constexpr std::int64_t kWindowNs = 20000;
  static constexpr int kWindows = 1000;
  static constexpr double kBuckSpeed = 11.0;      // m/s
  static constexpr double kFirstContact = 0.002;  // s
  static constexpr double kHeadContact = 0.012;   // s
  static constexpr double kSpin = 20.0;           // rad/s about z (up)
  static constexpr double kNeckPull = 400.0;      // N, tension
  static constexpr double kNeckFlexion = 15.0;    // N m about the condyles
  std::string run_id = "synthetic";
  bool has_fe = true;
  int fe_passes = 1;  // of a window, each of 3 ms, as the implicit scheme repeats them

  std::vector<RawMessage> messages() const;
};

}  // namespace crosswalk::recording
