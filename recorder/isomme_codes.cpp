// Channel codes of ISO/TS 13499 for our channels, and their conversion (isomme.h).
//
// test object D (dummy; here a human body model) · position 0 · main location HEAD · fine location
// CG · 00 · VH (50th percentile human male model) · physical dimension · direction · filter class.
// Directions 1, 2, 3 are axes that do not follow SAE J211: the laboratory frame W.
#include <algorithm>
#include <array>
#include <cmath>

#include "recorder/isomme.h"
#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

struct Code {
  const char* channel;
  const char* code;
};

constexpr std::array kCodes = {Code{"head_acceleration_x", "D0HEADCG00VHACXA"},
                               Code{"head_acceleration_y", "D0HEADCG00VHACYA"},
                               Code{"head_acceleration_z", "D0HEADCG00VHACZA"},
                               Code{"head_acceleration_resultant", "D0HEADCG00VHACRA"},
                               Code{"head_acceleration_world_x", "D0HEADCG00VHAC1A"},
                               Code{"head_acceleration_world_y", "D0HEADCG00VHAC2A"},
                               Code{"head_acceleration_world_z", "D0HEADCG00VHAC3A"},
                               Code{"head_angular_velocity_x", "D0HEADCG00VHAVXD"},
                               Code{"head_angular_velocity_y", "D0HEADCG00VHAVYD"},
                               Code{"head_angular_velocity_z", "D0HEADCG00VHAVZD"},
                               Code{"head_angular_velocity_resultant", "D0HEADCG00VHAVRD"},
                               Code{"head_angular_acceleration_x", "D0HEADCG00VHAAXD"},
                               Code{"head_angular_acceleration_y", "D0HEADCG00VHAAYD"},
                               Code{"head_angular_acceleration_z", "D0HEADCG00VHAAZD"},
                               Code{"head_angular_acceleration_resultant", "D0HEADCG00VHAARD"},
                               Code{"head_cog_x", "D0HEADCG00VHDS10"},
                               Code{"head_cog_y", "D0HEADCG00VHDS20"},
                               Code{"head_cog_z", "D0HEADCG00VHDS30"},
                               Code{"head_velocity_x", "D0HEADCG00VHVE10"},
                               Code{"head_velocity_y", "D0HEADCG00VHVE20"},
                               Code{"head_velocity_z", "D0HEADCG00VHVE30"},
                               Code{"head_speed_relative", "D0HEADCG00VHVER0"},
                               Code{"head_contact_force", "D0HEAD0000VHFOR0"},
                               Code{"neck_force_x", "D0NECKUP00VHFOXA"},
                               Code{"neck_force_y", "D0NECKUP00VHFOYA"},
                               Code{"neck_force_z", "D0NECKUP00VHFOZA"},
                               Code{"neck_moment_x", "D0NECKUP00VHMOXB"},
                               Code{"neck_moment_y", "D0NECKUP00VHMOYB"},
                               Code{"neck_moment_z", "D0NECKUP00VHMOZB"},
                               Code{"contact_car_total_x", "10VEHC000000FO10"},
                               Code{"contact_car_total_y", "10VEHC000000FO20"},
                               Code{"contact_car_total_z", "10VEHC000000FO30"},
                               Code{"buck_y", "10VEHCCG0000DS20"},
                               Code{"buck_velocity_y", "10VEHCCG0000VE20"}};

struct Unit {
  const char* ours;
  const char* mme;
  double divisor;  // of ours, exact where a factor would round
};

constexpr std::array kUnits = {Unit{"mm", "m", 1000},
                               Unit{"mps", "m/s", 1},
                               Unit{"mps2", "m/(s*s)", 1},
                               Unit{"radps", "rad/s", 1},
                               Unit{"radps2", "rad/(s*s)", 1},
                               Unit{"N", "N", 1},
                               Unit{"Nm", "N*m", 1},
                               Unit{"J", "J", 1},
                               Unit{"1", "1", 1}};

/// What a code measures: place, dimension and direction, without test object, dummy and filter
/// class.
std::string quantity_of(const std::string& code) {
  const std::string place = code.substr(6, 2) == "CG" ? "00" : code.substr(6, 2);
  return code.substr(2, 4) + place + code.substr(8, 2) + code.substr(12, 3);
}

/// Our channel of the same quantity; empty when there is none.
std::string channel_like(const std::string& code) {
  if (code.size() != 16) return {};
  for (const Code& c : kCodes) {
    if (quantity_of(code) == quantity_of(c.code)) return c.channel;
  }
  return {};
}

}  // namespace

std::string mme_code(const std::string& channel_name) {
  for (const Code& c : kCodes) {
    if (channel_name == c.channel) return c.code;
  }
  return {};
}

MmeTest mme_test(const std::string& name, const std::vector<Channel>& channels,
                 const MmeHeader& header) {
  MmeTest test{name, header, {}};
  for (const Channel& channel : channels) {
    const std::string code = mme_code(channel.name);
    if (code.empty()) continue;
    MmeChannel out;
    out.code = code;
    out.name = channel.name;
    double divisor = 1;
    for (const Unit& unit : kUnits) {
      if (channel.unit != unit.ours) continue;
      out.unit = unit.mme;
      divisor = unit.divisor;
    }
    out.header = {{"Comments", channel.description}};
    for (std::size_t i = 0; i < channel.samples.size(); ++i) {
      out.time.push_back(channel.time(i));
      out.values.push_back(channel.samples[i] / divisor);
    }
    test.channels.push_back(std::move(out));
  }
  return test;
}

std::vector<Channel> channels_of(const MmeTest& test) {
  std::vector<Channel> channels;
  for (const MmeChannel& c : test.channels) {
    const std::string name = channel_like(c.code);
    const auto unit =
        std::find_if(kUnits.begin(), kUnits.end(), [&c](const Unit& u) { return c.unit == u.mme; });
    if (name.empty() || unit == kUnits.end() || c.time.size() < 2 || !is_uniform(c.time)) continue;
    Channel out{name, unit->ours, c.code, c.time.front(), 0, c.values};
    out.dt = (c.time.back() - c.time.front()) / static_cast<double>(c.time.size() - 1);
    for (double& value : out.samples) value *= unit->divisor;
    channels.push_back(std::move(out));
  }
  return channels;
}

MmeChannel mme_constant(const std::string& code, const std::string& name, double value) {
  MmeChannel out;
  out.code = code;
  out.name = name;
  out.unit = "1";
  out.is_constant = true;
  out.values = {value};
  return out;
}

}  // namespace crosswalk::recording
