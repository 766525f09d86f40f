// Filters, HIC and relatives, rotational, neck and tissue metrics, risk curves against the vectors.
#include <gtest/gtest.h>

#include "common/rigid_fit.h"
#include "recorder/csv_table.h"
#include "recorder/scoring/score_json.h"
#include "recorder/signal.h"
#include "tests/recorder/vectors.h"

namespace crosswalk::recording {
namespace {

VectorSeries components(const CsvTable& table, const std::string& stem) {
  return {table.column("t"), table.column(stem + "x"), table.column(stem + "y"),
          table.column(stem + "z")};
}

TEST(FilterVectors, CoefficientsMatch) {
  const nlohmann::json vectors = expected("filter");
  for (const auto& row : vectors["coefficients"]) {
    const FilterForm form = row["variant"] == "iso6487" ? FilterForm::Iso6487 : FilterForm::SaeJ211;
    const CfcCoefficients c = cfc_coefficients(row["cfc"], row["dt"], form);
    EXPECT_NEAR(c.a0, row["a0"].get<double>(), 1e-12);
    EXPECT_NEAR(c.a1, row["a1"].get<double>(), 1e-12);
    EXPECT_NEAR(c.a2, row["a2"].get<double>(), 1e-12);
    EXPECT_NEAR(c.b1, row["b1"].get<double>(), 1e-12);
    EXPECT_NEAR(c.b2, row["b2"].get<double>(), 1e-12);
  }
}

TEST(FilterVectors, OutputsMatch) {
  const nlohmann::json vectors = expected("filter");
  const double tolerance = vectors["tolerance"]["absolute_over_peak"];
  for (const auto& item : vectors["cases"]) {
    const CsvTable table = read_csv(vector_folder("filter") / item["file"].get<std::string>());
    const std::vector<double>& raw = table.column("raw");
    double peak = 0;
    for (const double value : raw) peak = std::max(peak, std::abs(value));
    for (const std::string& name : table.names) {
      if (!name.starts_with("cfc")) continue;
      const double cfc = std::stod(name.substr(3));
      const FilterForm form = name.ends_with("_iso") ? FilterForm::Iso6487 : FilterForm::SaeJ211;
      const std::vector<double> y = cfc_filter(raw, item["dt"], cfc, form);
      const std::vector<double>& wanted = table.column(name);
      double worst = 0;
      for (std::size_t i = 0; i < y.size(); ++i)
        worst = std::max(worst, std::abs(y[i] - wanted[i]));
      EXPECT_LE(worst, tolerance * peak) << item["name"] << " " << name;
    }
  }
}

void expect_window(const nlohmann::json& wanted, const nlohmann::json& found, double relative,
                   double time, const std::string& where) {
  EXPECT_TRUE(is_close(found["value"], wanted["value"], relative)) << where << found << wanted;
  if (!wanted.value("window_unique", false)) return;
  EXPECT_NEAR(found["t1"].get<double>(), wanted["t1"].get<double>(), time * 1.001) << where;
  EXPECT_NEAR(found["t2"].get<double>(), wanted["t2"].get<double>(), time * 1.001) << where;
}

TEST(HicVectors, EveryCaseMatches) {
  const nlohmann::json vectors = expected("hic");
  const double relative = vectors["tolerance"]["relative"];
  const double time = vectors["tolerance"]["time_s"];
  for (const auto& item : vectors["cases"]) {
    const std::string name = item["name"];
    HeadSignals signals;
    signals.acceleration =
        components(read_csv(vector_folder("hic") / item["file"].get<std::string>()), "a");
    const nlohmann::json found = to_json(score_card(signals));
    for (const auto& [key, value] : item["expected"].items()) {
      ASSERT_TRUE(found.contains(key)) << name << ": " << key;
      if (value.is_object()) {
        expect_window(value, found[key], relative, time, name + ": " + key);
      } else if (value.is_number()) {
        EXPECT_TRUE(is_close(found[key], value, relative)) << name << ": " << key;
      } else {
        EXPECT_EQ(found[key], value) << name << ": " << key;
      }
    }
  }
}

TEST(RotationVectors, EveryCaseMatches) {
  const nlohmann::json vectors = expected("rotation");
  const double relative = vectors["tolerance"]["relative"];
  const double damage_relative = vectors["tolerance"]["DAMAGE_relative"];
  for (const auto& item : vectors["cases"]) {
    const std::string name = item["name"];
    const CsvTable table = read_csv(vector_folder("rotation") / item["file"].get<std::string>());
    HeadSignals signals;
    signals.acceleration = components(table, "a");
    signals.angular_velocity = components(table, "w");
    signals.angular_acceleration = components(table, "al");
    const nlohmann::json found = to_json(score_card(signals));
    for (const auto& [key, value] : item["expected"].items()) {
      ASSERT_TRUE(found.contains(key)) << name << ": " << key;
      if (key == "DAMAGE") {
        for (const char* part : {"value", "x", "y", "z"}) {
          EXPECT_TRUE(is_close(found[key][part], value[part], damage_relative, 1e-6))
              << name << ": " << part << " " << found[key][part] << " " << value[part];
        }
        EXPECT_NEAR(found[key]["time"].get<double>(), value["time"].get<double>(), 1e-4) << name;
      } else {
        const double number = found[key].is_object() ? found[key]["value"] : found[key];
        const double tolerance = key == "HARM" ? damage_relative : relative;
        EXPECT_TRUE(is_close(number, value, tolerance)) << name << ": " << key << " " << number;
      }
    }
  }
}

NeckParameters neck_parameters(const nlohmann::json& p) {
  return {p["e_m"], p["Fzt"], p["Fzc"], p["Mf"], p["Me"], p["nkm_F"], p["nkm_Mf"], p["nkm_Me"]};
}

TEST(NeckVectors, EveryCaseMatches) {
  const nlohmann::json vectors = expected("neck");
  const double relative = vectors["tolerance"]["relative"];
  for (const auto& item : vectors["cases"]) {
    const CsvTable table = read_csv(vector_folder("neck") / item["file"].get<std::string>());
    ScoreCard card;
    card.neck =
        neck_injury({table.column("t"), table.column("fx"), table.column("fz"), table.column("my")},
                    neck_parameters(vectors["parameters"]));
    const nlohmann::json found = nlohmann::json(to_json(card)).flatten();
    const nlohmann::json wanted = item["expected"].flatten();
    for (const auto& [key, value] : wanted.items()) {
      EXPECT_TRUE(is_close(found.at(key), value, relative)) << item["name"] << key;
    }
  }
}

TEST(BrainVectors, TissueMetricsMatch) {
  const nlohmann::json vectors = expected("brain");
  const CsvTable table = read_csv(vector_folder("brain") / vectors["file"].get<std::string>());
  ElementStrains elements;
  elements.volume = table.column("volume");
  for (std::size_t k = 2; k < table.names.size(); ++k) elements.strain.push_back(table.columns[k]);
  const nlohmann::json found = nlohmann::json(to_json(tissue_metrics(elements))).flatten();
  const nlohmann::json wanted = vectors["expected"].flatten();
  for (const auto& [key, value] : wanted.items()) {
    EXPECT_TRUE(is_close(found.at(key), value, vectors["tolerance"]["relative"])) << key;
  }
}

TEST(BrainVectors, PrincipalStrainsMatch) {
  const nlohmann::json vectors = expected("brain");
  const double tolerance = vectors["tolerance"]["strain"];
  for (const auto& item : vectors["principal"]) {
    Mat3 F;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) F(i, j) = item["F"][i][j];
    }
    const PrincipalStrains s = principal_strains(F);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(s.green[i], item["expected"]["green"][i].get<double>(), tolerance);
      EXPECT_NEAR(s.log[i], item["expected"]["log"][i].get<double>(), tolerance);
      EXPECT_NEAR(s.engineering[i], item["expected"]["engineering"][i].get<double>(), tolerance);
    }
  }
}

struct Nodes {
  std::vector<double> mass;
  std::vector<Vec3> reference, position, velocity, acceleration;
};

Nodes nodes_of_state(const CsvTable& table, int state) {
  Nodes nodes;
  const auto vec = [&table](std::size_t row, std::size_t first) {
    return Vec3(table.columns[first][row], table.columns[first + 1][row],
                table.columns[first + 2][row]);
  };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (static_cast<int>(table.column("state")[row]) != state) continue;
    nodes.mass.push_back(table.column("mass")[row]);
    nodes.reference.push_back(vec(row, 3));
    nodes.position.push_back(vec(row, 6));
    nodes.velocity.push_back(vec(row, 9));
    nodes.acceleration.push_back(vec(row, 12));
  }
  return nodes;
}

void expect_vec(const nlohmann::json& wanted, const Vec3& found, double relative,
                const std::string& where) {
  const Vec3 w(wanted[0], wanted[1], wanted[2]);
  EXPECT_LE((found - w).norm(), relative * std::max(1.0, w.norm())) << where;
}

TEST(NodeVectors, RigidFitMatches) {
  const nlohmann::json vectors = expected("nodes");
  const double rates = vectors["tolerance"]["rates_relative"];
  const CsvTable table = read_csv(vector_folder("nodes") / vectors["file"].get<std::string>());
  for (const auto& item : vectors["cases"]) {
    const Nodes n = nodes_of_state(table, item["state"]);
    const Pose X = fit_pose(n.reference, n.position, n.mass);
    const Vec3 centre = weighted_mean(n.position, n.mass);
    const Twist twist = fit_twist(n.position, n.velocity, n.mass, centre);
    const Vec3 alpha = fit_angular_acceleration(n.position, n.acceleration, n.mass, twist.w);
    const Mat3 R = X.R();
    const nlohmann::json& wanted = item["expected"];
    const std::string where = "state " + item["state"].dump();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(R(i, j), wanted["R"][i][j].get<double>(), vectors["tolerance"]["R"]) << where;
      }
    }
    EXPECT_NEAR(fit_residual(n.reference, n.position, n.mass, X), wanted["rms_m"].get<double>(),
                1e-9)
        << where;
    expect_vec(wanted["c"], centre, rates, where + " c");
    expect_vec(wanted["v_c"], twist.v, rates, where + " v_c");
    expect_vec(wanted["a_c"], weighted_mean(n.acceleration, n.mass), rates, where + " a_c");
    expect_vec(wanted["omega"], twist.w, rates, where + " omega");
    expect_vec(wanted["alpha"], alpha, rates, where + " alpha");
    expect_vec(wanted["omega_body"], R.transpose() * twist.w, rates, where + " omega_body");
    expect_vec(wanted["alpha_body"], R.transpose() * alpha, rates, where + " alpha_body");
  }
}

TEST(NodeVectors, FlatNodeSetKeepsAProperRotation) {
  const nlohmann::json flat = expected("nodes")["coplanar"];
  std::vector<Vec3> P, Q;
  for (const auto& p : flat["P"]) P.emplace_back(p[0], p[1], p[2]);
  for (const auto& q : flat["Q"]) Q.emplace_back(q[0], q[1], q[2]);
  const std::vector<double> mass(P.size(), 1.0);
  const Mat3 R = fit_pose(P, Q, mass).R();
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(R(i, j), flat["expected_R"][i][j].get<double>(), 1e-9);
  }
}

TEST(RiskVectors, EveryCurveMatches) {
  const nlohmann::json vectors = expected("risk");
  const double tolerance = vectors["tolerance"];
  const std::vector<std::pair<const char*, RiskFamily (*)(double)>> families = {
      {"hic_lognormal", risk_hic_lognormal},
      {"hic_logistic", risk_hic_logistic},
      {"bric_csdm", risk_bric_csdm},
      {"bric_mps", risk_bric_mps},
      {"damage", risk_damage},
      {"nij", risk_nij}};
  for (const auto& [key, family] : families) {
    ASSERT_TRUE(vectors.contains(key));
    for (const auto& row : vectors[key]) {
      double argument = 0;
      for (const auto& [name, value] : row.items()) {
        if (name != "p") argument = value;
      }
      for (const Risk& risk : family(argument).risks) {
        ASSERT_TRUE(row["p"].contains(risk.level)) << key << " " << risk.level;
        EXPECT_NEAR(risk.probability, row["p"][risk.level].get<double>(), tolerance) << key;
      }
    }
  }
}

}  // namespace
}  // namespace crosswalk::recording
