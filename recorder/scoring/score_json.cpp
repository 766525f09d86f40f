#include "recorder/scoring/score_json.h"

#include <functional>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/error.h"

namespace crosswalk::recording {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

template <typename Parameters>
using Member = std::pair<const char*, double Parameters::*>;

/// CORA's numeric parameters under CORA's names.
constexpr Member<CoraParameters> kCora[] = {{"A_THRES", &CoraParameters::A_THRES},
                                            {"B_THRES", &CoraParameters::B_THRES},
                                            {"A_EVAL", &CoraParameters::A_EVAL},
                                            {"B_DELTA_END", &CoraParameters::B_DELTA_END},
                                            {"K", &CoraParameters::K},
                                            {"G_1", &CoraParameters::G_1},
                                            {"G_2", &CoraParameters::G_2},
                                            {"a_0", &CoraParameters::a_0},
                                            {"b_0", &CoraParameters::b_0},
                                            {"a_sigma", &CoraParameters::a_sigma},
                                            {"b_sigma", &CoraParameters::b_sigma},
                                            {"D_MIN", &CoraParameters::D_MIN},
                                            {"D_MAX", &CoraParameters::D_MAX},
                                            {"INT_MIN", &CoraParameters::overlap_min},
                                            {"K_V", &CoraParameters::K_V},
                                            {"K_G", &CoraParameters::K_G},
                                            {"K_P", &CoraParameters::K_P},
                                            {"G_V", &CoraParameters::G_V},
                                            {"G_G", &CoraParameters::G_G},
                                            {"G_P", &CoraParameters::G_P}};

constexpr Member<Iso18571Parameters> kIso[] = {
    {"K_Z", &Iso18571Parameters::K_Z},     {"K_P", &Iso18571Parameters::K_P},
    {"K_M", &Iso18571Parameters::K_M},     {"K_S", &Iso18571Parameters::K_S},
    {"eps_P", &Iso18571Parameters::eps_P}, {"eps_M", &Iso18571Parameters::eps_M},
    {"eps_S", &Iso18571Parameters::eps_S}, {"a_0", &Iso18571Parameters::a_0},
    {"b_0", &Iso18571Parameters::b_0},     {"w_Z", &Iso18571Parameters::w_Z},
    {"w_P", &Iso18571Parameters::w_P},     {"w_M", &Iso18571Parameters::w_M},
    {"w_S", &Iso18571Parameters::w_S},     {"w_dtw", &Iso18571Parameters::w_dtw}};

constexpr std::optional<double> CoraParameters::*kOptional[] = {
    &CoraParameters::t_min, &CoraParameters::t_max, &CoraParameters::dt, &CoraParameters::Y_norm};
constexpr const char* kOptionalNames[] = {"t_min", "t_max", "dt", "Y_norm"};

[[noreturn]] void bad(const std::string& message) {
  throw SignalError(SignalFault::BadParameter, "parameters: " + message);
}

double number(const std::string& key, const json& value) {
  if (!value.is_number()) bad(fmt::format("{}: expected a number, found {}", key, value.dump()));
  return value.get<double>();
}

CoraInterval interval(const json& value) {
  if (value == "full") return CoraInterval::Full;
  if (value == "manual") return CoraInterval::Manual;
  if (value == "auto") return CoraInterval::Automatic;
  bad(fmt::format("interval: expected full, manual or auto, found {}", value.dump()));
}

const char* text(CoraInterval value) {
  switch (value) {
    case CoraInterval::Full:
      return "full";
    case CoraInterval::Manual:
      return "manual";
    case CoraInterval::Automatic:
      return "auto";
  }
  return "full";
}

template <typename Table, typename Parameters>
bool assign(const Table& table, Parameters& parameters, const std::string& key, const json& value) {
  for (const auto& [name, member] : table) {
    if (key != name) continue;
    parameters.*member = number(key, value);
    return true;
  }
  return false;
}

/// Keys of CORA's control file whose values are words or act on the interval. False: not one.
bool assign_control_file_key(CoraParameters& p, const std::string& key, const json& value) {
  if (key == "T_MIN" || key == "T_MAX") {
    if (value == "automatic") {
      p.interval = CoraInterval::Automatic;
      return true;
    }
    (key == "T_MIN" ? p.t_min : p.t_max) = number(key, value);
    return true;
  }
  if (key == "Y_NORM") {
    if (value != "extremum") p.Y_norm = number(key, value);
    return true;
  }
  if (key == "WF_NORM") {
    if (value != "YES") bad("WF_NORM: only YES, weights are always normalised");
    return true;
  }
  if (key == "MIN_NORM") {
    if (number(key, value) != 0) bad("MIN_NORM: only 0 (off); give Y_norm for a weak axis");
    return true;
  }
  return false;
}

template <typename Table>
std::vector<std::string> names(const Table& table) {
  std::vector<std::string> out;
  for (const auto& entry : table) out.emplace_back(entry.first);
  return out;
}

[[noreturn]] void unknown(const std::string& key, std::vector<std::string> known) {
  const std::string near = did_you_mean(key, known);
  bad(fmt::format("{}: unknown key{}", key, near.empty() ? "" : "; did you mean " + near + "?"));
}

ordered_json to_json(const WindowMaximum& w) {
  ordered_json out;
  out["value"] = w.value;
  out["t1"] = w.t1 ? ordered_json(*w.t1) : ordered_json(nullptr);
  out["t2"] = w.t2 ? ordered_json(*w.t2) : ordered_json(nullptr);
  out["window_unique"] = w.is_unique;
  return out;
}

void add(ordered_json& out, const LinearScores& s) {
  out["peak_g"] = s.peak_g;
  out["HIC15"] = to_json(s.HIC15);
  out["HIC36"] = to_json(s.HIC36);
  if (s.clip_single) {
    out["clip3ms_single_g"] = to_json(*s.clip_single);
    out["clip3ms_cumulative_g"] = *s.clip_cumulative;
  } else {
    out["clip3ms_error"] = "too_short";
  }
  out["GSI"] = s.GSI;
}

void add(ordered_json& out, const RotationScores& s) {
  out["peak_w"] = s.peak_w;
  out["peak_alpha"] = s.peak_alpha;
  out["BrIC_csdm"] = s.BrIC.csdm;
  out["BrIC_mps"] = s.BrIC.mps;
  out["BrIC_avg"] = s.BrIC.avg;
  out["UBrIC_mps_p2p"] = s.UBrIC_p2p;
  out["UBrIC_mps_max"] = s.UBrIC_max;
  out["DAMAGE"] = {{"value", s.DAMAGE.value},
                   {"time", s.DAMAGE.time},
                   {"x", s.DAMAGE.x},
                   {"y", s.DAMAGE.y},
                   {"z", s.DAMAGE.z}};
  out["RIC15"] = s.RIC15;
  out["RIC36"] = s.RIC36;
}

void add(ordered_json& out, const CombinedScores& s) {
  out["GAMBIT_2"] = s.GAMBIT_2;
  out["GAMBIT_2p5"] = s.GAMBIT_2p5;
  out["HIP_W"] = s.HIP_W;
  out["PRHIC15"] = s.PRHIC15;
  out["PRHIC36"] = s.PRHIC36;
  out["KLC"] = s.KLC;
  out["HARM"] = s.HARM;
}

void add(ordered_json& out, const NeckResult& s) {
  out["Nij"] = s.Nij;
  out["Nij_modes"] = {{"NTF", s.NTF}, {"NTE", s.NTE}, {"NCF", s.NCF}, {"NCE", s.NCE}};
  out["Nkm"] = s.Nkm;
  out["Nkm_modes"] = {{"NFA", s.NFA}, {"NEA", s.NEA}, {"NFP", s.NFP}, {"NEP", s.NEP}};
}

}  // namespace

ordered_json to_json(const CoraResult& r) {
  return {{"C", r.C},   {"C1", r.C1},       {"C2", r.C2},       {"V", r.V},          {"G", r.G},
          {"P", r.P},   {"K_max", r.K_max}, {"m", r.m},         {"delta", r.delta},  {"n", r.n},
          {"dt", r.dt}, {"t_min", r.t_min}, {"t_max", r.t_max}, {"Y_norm", r.Y_norm}};
}

ordered_json to_json(const CoraParameters& p) {
  ordered_json out;
  out["interval"] = text(p.interval);
  for (std::size_t i = 0; i < std::size(kOptional); ++i) {
    const auto& value = p.*kOptional[i];
    out[kOptionalNames[i]] = value ? ordered_json(*value) : ordered_json(nullptr);
  }
  for (const auto& [name, member] : kCora) out[name] = p.*member;
  return out;
}

ordered_json to_json(const Iso18571Result& r) {
  ordered_json out = {{"R", r.R},
                      {"Z", r.Z},
                      {"EP", r.EP},
                      {"EM", r.EM},
                      {"ES", r.ES},
                      {"rho_E", r.rho_E},
                      {"n_eps", r.n_eps},
                      {"ref_start", r.ref_start},
                      {"sim_start", r.sim_start}};
  out["e_mag"] = r.e_mag ? ordered_json(*r.e_mag) : ordered_json(nullptr);
  out["e_slope"] = r.e_slope ? ordered_json(*r.e_slope) : ordered_json(nullptr);
  out["grade"] = r.grade;
  return out;
}

ordered_json to_json(const Iso18571Parameters& p) {
  ordered_json out;
  for (const auto& [name, member] : kIso) out[name] = p.*member;
  return out;
}

ordered_json to_json(const ScoreCard& card) {
  ordered_json out = ordered_json::object();
  if (card.linear) add(out, *card.linear);
  if (card.rotation) add(out, *card.rotation);
  if (card.combined) add(out, *card.combined);
  if (card.neck) add(out, *card.neck);
  ordered_json risks = ordered_json::object();
  for (const RiskFamily& family : card.risks) {
    ordered_json& entry = risks[family.key];
    entry["author"] = family.author;
    for (const Risk& risk : family.risks) entry[risk.level] = risk.probability;
  }
  if (!risks.empty()) out["risk"] = risks;
  if (!card.notes.empty()) out["notes"] = card.notes;
  return out;
}

ordered_json to_json(const TissueMetrics& m) {
  ordered_json out = {{"MPS_max", m.mps_max},
                      {"MPS95_peak_linear", m.mps95},
                      {"MPS95_peak_volume", m.mps95_volume},
                      {"MPS95_state_max", m.mps95_state_max},
                      {"MPS50_peak_linear", m.mps50}};
  for (const auto& [level, share] : m.csdm) out["CSDM"][fmt::format("{:.2f}", level)] = share;
  return out;
}

CoraParameters cora_parameters(const json& object) {
  if (!object.is_object()) bad("expected a JSON object");
  CoraParameters p;
  for (const auto& [key, value] : object.items()) {
    if (key == "interval") {
      p.interval = interval(value);
      continue;
    }
    if (assign(kCora, p, key, value) || assign_control_file_key(p, key, value)) continue;
    bool is_known = false;
    for (std::size_t i = 0; i < std::size(kOptional); ++i) {
      if (key != kOptionalNames[i]) continue;
      is_known = true;
      if (!value.is_null()) p.*kOptional[i] = number(key, value);
    }
    std::vector<std::string> known = names(kCora);
    known.insert(known.end(), {"interval", "t_min", "t_max", "dt", "Y_norm", "T_MIN", "T_MAX",
                               "Y_NORM", "WF_NORM", "MIN_NORM"});
    if (!is_known) unknown(key, known);
  }
  if (p.interval == CoraInterval::Full && (p.t_min || p.t_max)) {
    if (object.contains("interval")) bad("interval: full, but an edge of the interval is given");
    p.interval = CoraInterval::Manual;
  }
  return p;
}

Iso18571Parameters iso18571_parameters(const json& object) {
  if (!object.is_object()) bad("expected a JSON object");
  Iso18571Parameters p;
  for (const auto& [key, value] : object.items()) {
    if (!assign(kIso, p, key, value)) unknown(key, names(kIso));
  }
  return p;
}

}  // namespace crosswalk::recording
