// Passing from one part of the car's front to the next: no energy comes from nothing. Closed forms
// on flat and bent fronts of elastic panels, and the book of a contact with hysteresis.
#include "mb_node/front_contact.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/units.h"

namespace crosswalk::mb {
namespace {

constexpr double kRadius = 0.1, kMass = 5;

struct PanelSpec {
  double stiffness = 0, permanent = 0;
};

/// Two panels of 1 m; the second bends up by `bend` (towards the side the sphere is on).
VehicleFront two_panels(const PanelSpec& first, const PanelSpec& second, double bend) {
  VehicleFront front;
  front.components = {{"first", "estimated", first.permanent},
                      {"second", "estimated", second.permanent}};
  const Eigen::Vector2d joint(0, 0.8), along(-std::cos(bend), std::sin(bend));
  const auto add = [&](const Eigen::Vector2d& begin, const Eigen::Vector2d& end,
                       const PanelSpec& spec, int component) {
    FrontFacet facet{
        front.components[component].name,
        begin,
        end,
        {},
        1.0,
        {Curve({0, 1}, {0, spec.stiffness}, Curve::Outside::LastSlope), spec.permanent, 1}};
    const Eigen::Vector2d t = (end - begin).normalized();
    facet.normal = {t.y(), -t.x()};
    front.facets.push_back(facet);
    front.facet_component.push_back(component);
  };
  add(joint + Eigen::Vector2d(1, 0), joint, first, 0);
  add(joint, joint + along, second, 1);
  return front;
}

/// A sphere that slides over the front without friction, pressed down by a constant load.
struct Slide {
  explicit Slide(VehicleFront f) : front(std::move(f)), chains(convex_chains(front)) {
    panels = front_panels(front, chains);
    for (const int c : panels.component) laws.emplace_back(front.facets[c].structure);
    for (const ContactLaw& law : laws) law_of_panel.push_back(&law);
    contacts.resize(panels.count());
  }

  void step(double dt) {
    const PosedEllipsoid sphere({0, p.x(), p.y()}, Mat3::Identity(), Vec3::Constant(kRadius));
    std::vector<PanelTouch> touches;
    std::vector<Overlap> overlaps;
    for (const FrontChain& chain : chains) {
      const auto found = overlap_with_front(sphere, front, chain, {});
      if (!found) continue;
      touches.push_back({panels.of_facet[found->facet], found->overlap.depth,
                         -v.dot(found->overlap.normal.tail<2>())});
      overlaps.push_back(found->overlap);
    }
    const FrontLosses lost = press_in(touches, law_of_panel, dt, contacts);
    hysteresis += lost.hysteresis;
    left += lost.left;
    force = Eigen::Vector2d(0, -load);
    stored = 0;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      const PanelContact& c = contacts[touches[i].panel];
      force += laws[touches[i].panel].force(c.pressed, c.deepest) * overlaps[i].normal.tail<2>();
      stored += laws[touches[i].panel].stored_energy(c.pressed, c.deepest);
    }
    // Energies at this position: the velocity half-way through the step's kick.
    v += 0.5 * dt / kMass * force;
    energy = 0.5 * kMass * v.squaredNorm() + load * p.y() + stored;
    v += 0.5 * dt / kMass * force;
    p += dt * v;
  }

  VehicleFront front;
  std::vector<FrontChain> chains;
  FrontPanels panels;
  std::vector<ContactLaw> laws;
  std::vector<const ContactLaw*> law_of_panel;
  std::vector<PanelContact> contacts;
  Eigen::Vector2d p = {0.3, 0.8 + kRadius}, v = Eigen::Vector2d::Zero(), force = {};
  double load = 0, stored = 0, energy = 0, hysteresis = 0, left = 0;
};

struct Books {
  double start = 0, end = 0, highest = -1e9, hysteresis = 0, left = 0;
};

/// Slides from rest depth load / stiffness on the first panel over the joint.
Books slide(const PanelSpec& first, const PanelSpec& second, double bend, double speed,
            double seconds) {
  Slide s(two_panels(first, second, bend));
  s.load = 2000;
  s.p.y() = 0.8 + kRadius;
  const double dt = 2e-6;
  // Let down onto the first panel without kinetic energy left.
  const double depth = s.load / first.stiffness;
  for (int i = 1; i <= 1000; ++i) {
    s.p = {0.3, 0.8 + kRadius - depth * i / 1000};
    s.v = {0, -depth / 1000 / dt};
    s.step(dt);
  }
  s.p = {0.3, 0.8 + kRadius - depth};
  s.v = {-speed, 0};
  s.hysteresis = s.left = 0;
  Books b;
  for (double t = 0; t < seconds; t += dt) {
    s.step(dt);
    if (t == 0) b.start = s.energy;
    b.highest = std::max(b.highest, s.energy + s.hysteresis + s.left);
    b.end = s.energy;
  }
  b.hysteresis = s.hysteresis;
  b.left = s.left;
  return b;
}

TEST(FrontPanels, AreTheRunsOfOneComponentInAChain) {
  const VehicleFront flat = two_panels({1e5, 0}, {2e5, 0}, 0);
  const FrontPanels panels = front_panels(flat, convex_chains(flat));
  EXPECT_EQ(panels.of_facet, (std::vector<int>{0, 1}));
  EXPECT_EQ(panels.component, (std::vector<int>{0, 1}));
}

TEST(Passage, OntoAStifferElasticPanelKeepsTheEnergyExactly) {
  // Old reading: pressed into the new panel at once by the same depth, a gain of
  // (k2 - k1) d^2 / 2 = 60 J here. k2 holds the stored energy at d sqrt(k1 / k2).
  const double k1 = 1e5, k2 = 4e5, d = 2000 / k1;
  const Books b = slide({k1, 0}, {k2, 0}, 0, 5, 0.12);
  const double scale = 0.5 * k1 * d * d;
  EXPECT_NEAR(b.end, b.start, 1e-3 * scale);
  EXPECT_LT(b.highest, b.start + 1e-3 * scale);
  EXPECT_NEAR(b.left, 0, 1e-9 * scale);
}

TEST(Passage, HandsOverTheDepthThatHoldsTheStoredEnergy) {
  const double k1 = 1e5, k2 = 4e5, d = 0.02;
  const ContactLaw first({Curve({0, 1}, {0, k1}), 0, 1}), second({Curve({0, 1}, {0, k2}), 0, 1});
  const std::vector<const ContactLaw*> laws = {&first, &second};
  std::vector<PanelContact> contacts(2);
  contacts[0] = {d, d, 0, true};
  const PanelTouch touch{1, d, 0};
  const FrontLosses lost = press_in({&touch, 1}, laws, 1e-5, contacts);
  EXPECT_NEAR(contacts[1].pressed, d * std::sqrt(k1 / k2), 1e-9);
  EXPECT_NEAR(contacts[1].pressed + contacts[1].unpressed, d, 1e-15);
  EXPECT_NEAR(lost.left, 0, 1e-6);
  EXPECT_EQ(lost.hysteresis, 0);
  EXPECT_FALSE(contacts[0].is_touching);
}

TEST(Passage, OntoASofterPanelLosesWhatItCannotHold) {
  // Pressed in by d and no more: k2 d^2 / 2 of k1 d^2 / 2 is held.
  const double k1 = 4e5, k2 = 1e5, d = 2000 / k1;
  const Books b = slide({k1, 0}, {k2, 0}, 0, 5, 0.12);
  EXPECT_NEAR(b.left, 0.5 * (k1 - k2) * d * d, 1e-6);
  EXPECT_NEAR(b.start - b.end, b.left, 1e-2 * b.left);
}

TEST(Passage, IntoACornerGainsNothing) {
  // Bends like hood and glass, and like bumper and steep grille; both panels touch in the corner.
  for (const double bend : {17 * kDegree, 45 * kDegree}) {
    for (const double k2 : {5e4, 1e5, 4e5}) {
      const double k1 = 1e5, d = 2000 / k1;
      const Books b = slide({k1, 0}, {k2, 0}, bend, 5, 0.1);
      const double scale = 0.5 * k1 * d * d;
      EXPECT_LT(b.highest, b.start + 2e-3 * scale) << bend << ' ' << k2;
      EXPECT_NEAR(b.start - b.end, b.left, 2e-2 * (scale + b.left)) << bend << ' ' << k2;
    }
  }
}

TEST(Passage, BookOfDentsCloses) {
  // 80 and 60 % permanent: kinetic + load + stored + lost stays, to the error of the steps.
  for (const double bend : {0.0, 17 * kDegree}) {
    const Books b = slide({1e5, 0.8}, {5e4, 0.6}, bend, 5, 0.1);
    const double lost = b.hysteresis + b.left;
    EXPECT_GT(lost, 1) << bend;
    EXPECT_NEAR(b.start - b.end, lost, 0.01 * lost) << bend;
  }
}

TEST(PressIn, FirstTouchFollowsTheOverlapAndADentStays) {
  const ContactLaw law({Curve({0, 1}, {0, 1e5}), 0.5, 1});
  const std::vector<const ContactLaw*> laws = {&law};
  std::vector<PanelContact> contacts(1);
  const double dt = 1e-5, v = 10;
  double d = 0;
  for (int i = 0; i < 200; ++i) {
    d += v * dt;
    const PanelTouch touch{0, d, v};
    press_in({&touch, 1}, laws, dt, contacts);
    EXPECT_NEAR(contacts[0].pressed, d, 1e-12);
  }
  press_in({}, laws, dt, contacts);
  EXPECT_FALSE(contacts[0].is_touching);
  EXPECT_NEAR(contacts[0].deepest, d, 1e-12);
  // Back beside the dent's bottom: what was crushed before is no new overlap.
  const PanelTouch back{0, 0.7 * d, 0};
  press_in({&back, 1}, laws, dt, contacts);
  EXPECT_NEAR(contacts[0].pressed, 0.5 * d, 1e-12);
  EXPECT_NEAR(law.force(contacts[0].pressed, contacts[0].deepest), 0, 1e-9);
}

}  // namespace
}  // namespace crosswalk::mb
