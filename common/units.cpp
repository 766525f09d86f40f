#include "common/units.h"

#include <array>

namespace crosswalk {

namespace {

constexpr Unit kLength[] = {
    {"m", "m", 1}, {"cm", "cm", 1e-2}, {"mm", "mm", 1e-3}, {"um", "um", 1e-6}};
constexpr Unit kMass[] = {{"kg", "kg", 1}, {"g", "g", 1e-3}, {"mg", "mg", 1e-6}};
constexpr Unit kTime[] = {
    {"s", "s", 1}, {"ms", "ms", 1e-3}, {"us", "us", 1e-6}, {"ns", "ns", 1e-9}};
constexpr Unit kAngle[] = {{"rad", "rad", 1}, {"deg", "deg", kDegree}};
constexpr Unit kSpeed[] = {{"m_s", "m/s", 1}, {"km_h", "km/h", 1 / 3.6}, {"mm_ms", "mm/ms", 1}};
constexpr Unit kAcceleration[] = {
    {"m_s2", "m/s2", 1}, {"g", "g", kStandardGravity}, {"mm_ms2", "mm/ms2", 1e3}};
constexpr Unit kAngularSpeed[] = {{"rad_s", "rad/s", 1}, {"deg_s", "deg/s", kDegree}};
constexpr Unit kForce[] = {{"N", "N", 1}, {"kN", "kN", 1e3}};
constexpr Unit kMoment[] = {{"N_m", "N m", 1}, {"kN_m", "kN m", 1e3}, {"N_mm", "N mm", 1e-3}};
constexpr Unit kStress[] = {
    {"Pa", "Pa", 1}, {"kPa", "kPa", 1e3}, {"MPa", "MPa", 1e6}, {"GPa", "GPa", 1e9}};
constexpr Unit kDensity[] = {
    {"kg_m3", "kg/m3", 1}, {"g_cm3", "g/cm3", 1e3}, {"t_mm3", "t/mm3", 1e12}};
constexpr Unit kStiffness[] = {{"N_per_m", "N/m", 1},
                               {"kN_per_m", "kN/m", 1e3},
                               {"N_per_mm", "N/mm", 1e3},
                               {"kN_per_mm", "kN/mm", 1e6}};
constexpr Unit kAngularStiffness[] = {{"N_m_per_rad", "N m/rad", 1},
                                      {"N_m_per_deg", "N m/deg", 1 / kDegree}};
constexpr Unit kDamping[] = {
    {"N_s_per_m", "N s/m", 1}, {"kN_s_per_m", "kN s/m", 1e3}, {"N_s_per_mm", "N s/mm", 1e3}};
constexpr Unit kAngularDamping[] = {{"N_m_s_per_rad", "N m s/rad", 1},
                                    {"N_m_s_per_deg", "N m s/deg", 1 / kDegree}};
constexpr Unit kInertia[] = {
    {"kg_m2", "kg m2", 1}, {"kg_cm2", "kg cm2", 1e-4}, {"kg_mm2", "kg mm2", 1e-6}};
constexpr Unit kFrequency[] = {{"Hz", "Hz", 1}, {"kHz", "kHz", 1e3}};
constexpr Unit kEnergy[] = {{"J", "J", 1}, {"kJ", "kJ", 1e3}, {"mJ", "mJ", 1e-3}};
constexpr Unit kTemperature[] = {{"K", "K", 1}, {"degC", "degC", 1, 273.15}};

struct Entry {
  std::string_view name;
  std::span<const Unit> units;
};

// In the order of Dimension.
constexpr std::array<Entry, kDimensionCount> kTable = {{
    {"a number", {}},
    {"a length", kLength},
    {"a mass", kMass},
    {"a time", kTime},
    {"an angle", kAngle},
    {"a speed", kSpeed},
    {"an acceleration", kAcceleration},
    {"an angular speed", kAngularSpeed},
    {"a force", kForce},
    {"a moment", kMoment},
    {"a stress", kStress},
    {"a density", kDensity},
    {"a stiffness", kStiffness},
    {"an angular stiffness", kAngularStiffness},
    {"a damping", kDamping},
    {"an angular damping", kAngularDamping},
    {"a moment of inertia", kInertia},
    {"a frequency", kFrequency},
    {"an energy", kEnergy},
    {"a temperature", kTemperature},
}};

}  // namespace

std::span<const Unit> units_of(Dimension dimension) {
  return kTable[static_cast<std::size_t>(dimension)].units;
}

std::string_view dimension_name(Dimension dimension) {
  return kTable[static_cast<std::size_t>(dimension)].name;
}

std::string suffix_list(Dimension dimension) {
  const auto units = units_of(dimension);
  std::string list;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (i > 0) list += i + 1 == units.size() ? " or " : ", ";
    list += '_';
    list += units[i].suffix;
  }
  return list;
}

}  // namespace crosswalk
