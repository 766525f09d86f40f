// Contact law: closed forms of series compliance and hysteresis; impacts of rigid masses on the
// buck's components against independently computed responses.
#include "mb_node/contact_law.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "common/units.h"
#include "tests/common/subject_fixture.h"
#include "tests/source_folder.h"

namespace crosswalk::mb {
namespace {

Characteristic linear(double stiffness, double permanent, double exponent) {
  return {Curve({0, 0.1}, {0, 0.1 * stiffness}, Curve::Outside::LastSlope), permanent, exponent};
}

TEST(ContactLaw, LinearSidesAddTheirCompliances) {
  const ContactLaw law(linear(8e4, 0, 1), linear(2e4, 0, 1));
  const double series = 1 / (1 / 8e4 + 1 / 2e4);
  for (const double d : {1e-4, 0.01, 0.05, 0.3}) {
    EXPECT_NEAR(law.force(d, d), series * d, 1e-9 * series);
    EXPECT_NEAR(law.force(0.5 * d, d), series * 0.5 * d, 1e-9 * series);  // elastic both
  }
}

TEST(ContactLaw, UnloadsAlongTheStatedPath) {
  const double k = 5e4, r = 0.4, e = 1.5, deepest = 0.05;
  const ContactLaw law(linear(k, r, e));
  for (const double d : {0.01, 0.025, 0.03, 0.045}) {
    const double x = std::max(0.0, (d - r * deepest) / (deepest - r * deepest));
    EXPECT_NEAR(law.force(d, deepest), k * deepest * std::pow(x, e), 1e-9 * k);
  }
  EXPECT_NEAR(law.permanent(deepest), r * deepest, 1e-12);
}

TEST(ContactLaw, SidesMeetAtEqualForceOnTheWayBack) {
  const Characteristic flesh = linear(8e4, 0.5, 1.5), metal = linear(3e4, 0.8, 1);
  const ContactLaw law(flesh, metal);
  const double deepest = 0.06, d = 0.05;
  const double f = law.force(d, deepest) / law.force(deepest, deepest);
  const double share_flesh = deepest * 3e4 / 11e4, share_metal = deepest - share_flesh;
  const double total =
      share_flesh * (0.5 + 0.5 * std::pow(f, 1 / 1.5)) + share_metal * (0.8 + 0.2 * f);
  EXPECT_NEAR(total, d, 1e-9);
}

TEST(ContactLaw, WorkOfACycleIsTheLossInClosedForm) {
  const ContactLaw law(linear(8e4, 0.5, 1.5), linear(3e4, 0.8, 1));
  const double deepest = 0.06;
  const int n = 60000;
  double up = 0, down = 0;
  for (int i = 0; i < n; ++i) {
    const double d = deepest * (i + 0.5) / n;
    up += law.force(d, d) * deepest / n;
    down += law.force(d, deepest) * deepest / n;
  }
  EXPECT_NEAR(up, law.loading_energy(deepest), 1e-6 * up);
  EXPECT_NEAR(down, law.recoverable_energy(deepest), 1e-5 * up);
}

TEST(ContactLaw, StoredEnergyIsTheWorkOfTheWayBack) {
  const ContactLaw law(linear(8e4, 0.5, 1.5), linear(3e4, 0.8, 1));
  const double deepest = 0.06;
  const int n = 60000;
  double work = 0;
  for (int i = 0; i < n; ++i) {
    const double d = deepest * (i + 0.5) / n;
    work += law.force(d, deepest) * deepest / n;
    if (i % 12000 != 11999) continue;
    const double reached = deepest * (i + 1) / n;
    EXPECT_NEAR(law.stored_energy(reached, deepest), work, 1e-5 * law.recoverable_energy(deepest));
  }
}

TEST(ContactLaw, PenetrationHoldingIsTheInverseOfTheStoredEnergy) {
  const ContactLaw law(linear(8e4, 0.5, 1.5), linear(3e4, 0.8, 1));
  const double deepest = 0.06;
  for (const double d : {0.05, 0.055, 0.06, 0.07, 0.1}) {
    const double energy = law.stored_energy(d, std::max(d, deepest));
    EXPECT_NEAR(law.penetration_holding(energy, deepest, 1), d, 1e-9) << d;
    EXPECT_NEAR(law.penetration_holding(energy, deepest, 0.8 * d), 0.8 * d, 1e-9) << d;
  }
  EXPECT_NEAR(law.penetration_holding(0, deepest, 1), law.permanent(deepest), 1e-9);
  EXPECT_EQ(law.penetration_holding(0, 0, 1), 0);
}

TEST(ContactLaw, BreakingSideDropsTheForceAtConstantPenetration) {
  // Glass: 4 kN at 4 mm, then 2 kN at 8 mm; soft flesh in series cannot follow: it snaps through.
  const Characteristic glass = {
      Curve({0, 4e-3, 8e-3, 0.1}, {0, 4e3, 2e3, 2e4}, Curve::Outside::LastSlope), 0.9, 1};
  const ContactLaw law(linear(8e4, 0, 1), glass);
  const double at_peak = 4e3 / 8e4 + 4e-3;
  EXPECT_NEAR(law.force(at_peak - 1e-6, at_peak - 1e-6), 4e3, 1);
  EXPECT_LT(law.force(at_peak + 1e-6, at_peak + 1e-6), 3.9e3);
  double before = 0;
  for (double d = at_peak + 1e-4; d < 0.2; d += 1e-4) {
    EXPECT_GE(law.force(d, d), before);
    before = law.force(d, d);
  }
}

struct Golden {
  std::string component;
  double mass, speed, peak_g, t_peak_ms, depth_mm, rebound, duration_ms, hic, force_kN;
};

std::vector<Golden> read_golden() {
  std::ifstream file(source_folder() / "tests/mb_node/data/buck_component_golden_response.csv");
  std::vector<Golden> rows;
  for (std::string line; std::getline(file, line);) {
    if (line[0] == '#' || line.rfind("component,", 0) == 0) continue;
    std::istringstream cells(line);
    Golden g;
    std::getline(cells, g.component, ',');
    std::vector<double> v;
    for (std::string cell; std::getline(cells, cell, ',');) {
      v.push_back(cell.empty() ? 0 : std::stod(cell));
    }
    rows.push_back({g.component, v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]});
  }
  return rows;
}

// Head injury criterion over windows of at most 15 ms of an acceleration in g sampled at dt.
double hic15(const std::vector<double>& a, double dt) {
  std::vector<double> velocity = {0};
  for (std::size_t i = 1; i < a.size(); ++i) {
    velocity.push_back(velocity.back() + 0.5 * (a[i] + a[i - 1]) * dt);
  }
  const std::size_t widest = static_cast<std::size_t>(std::lround(0.015 / dt));
  double best = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(a.size(), i + widest + 1); ++j) {
      const double t = static_cast<double>(j - i) * dt;
      best = std::max(best, t * std::pow((velocity[j] - velocity[i]) / t, 2.5));
    }
  }
  return best;
}

TEST(ContactLaw, RigidMassesOnTheBuckMatchTheGoldenResponses) {
  const VehicleFront front = load_front("generic_sedan_buck");
  const std::vector<Golden> rows = read_golden();
  ASSERT_EQ(rows.size(), 10u);
  for (const Golden& g : rows) {
    const auto facet = std::find_if(front.facets.begin(), front.facets.end(),
                                    [&](const auto& f) { return f.component == g.component; });
    ASSERT_NE(facet, front.facets.end()) << g.component;
    const ContactLaw law(facet->structure);
    const double dt = 1e-6;
    double d = 0, v = g.speed, deepest = 0, t = 0, peak = 0, t_peak = 0, end = 0;
    double force = 0;
    std::vector<double> sampled;  // every 50 us
    for (int i = 0; t < 0.03; ++i) {
      if (i % 50 == 0) sampled.push_back(force / g.mass / kStandardGravity);
      v -= 0.5 * dt * force / g.mass;
      d += dt * v;
      deepest = std::max(deepest, d);
      force = law.force(d, deepest);
      v -= 0.5 * dt * force / g.mass;
      t += dt;
      if (force > peak) {
        peak = force;
        t_peak = t;
      }
      if (force > 0) end = t;
    }
    const std::string what = g.component + " " + std::to_string(g.speed);
    EXPECT_NEAR(peak / g.mass / kStandardGravity, g.peak_g, 5e-3 * g.peak_g) << what;
    EXPECT_NEAR(1e3 * deepest, g.depth_mm, 5e-3 * g.depth_mm) << what;
    EXPECT_NEAR(-v, g.rebound, 1e-2 * g.rebound) << what;
    EXPECT_NEAR(1e3 * t_peak, g.t_peak_ms, 0.02) << what;
    EXPECT_NEAR(1e3 * end, g.duration_ms, 0.02) << what;
    if (g.hic > 0) {
      EXPECT_NEAR(hic15(sampled, 50e-6), g.hic, 2e-2 * g.hic) << what;
    }
  }
}

}  // namespace
}  // namespace crosswalk::mb
