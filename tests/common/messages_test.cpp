#include "common/messages.h"

#include <limits>

#include <gtest/gtest.h>

#include "common/message_gate.h"
#include "crosswalk/msg/body_states.hpp"
#include "crosswalk/msg/contact_forces.hpp"
#include "crosswalk/msg/coupling_audit.hpp"
#include "crosswalk/msg/head_kinematics.hpp"
#include "crosswalk/msg/tissue_strain.hpp"

namespace crosswalk {
namespace {

Vec6 numbers(double start) {
  Vec6 a;
  for (int i = 0; i < 6; ++i) a[i] = start + 0.1 * i;
  return a;
}

BodyMotion some_motion() {
  return {{exp_rotation({0.1, -0.2, 0.3}), {1, 2, 3}}, {{4, 5, 6}, {7, 8, 9}}};
}

template <class M>
int encoded_size() {
  return M{}.getEncodedSize();
}

TEST(Messages, EveryFixedMessageFitsOneEthernetFrame) {
  for (const int size : {encoded_size<msg::step_to_mb>(), encoded_size<msg::mb_done>(),
                         encoded_size<msg::step_to_fe>(), encoded_size<msg::fe_done>(),
                         encoded_size<msg::mobility>(), encoded_size<msg::boundary_motion>(),
                         encoded_size<msg::boundary_mass>(), encoded_size<msg::head_kinematics>(),
                         encoded_size<msg::body_states>(), encoded_size<msg::contact_forces>(),
                         encoded_size<msg::tissue_strain>(), encoded_size<msg::coupling_audit>()}) {
    EXPECT_LE(size, kMaxMessageBytes);
  }
}

TEST(Messages, GrantsSurviveTheWireBitForBitAfterRounding) {
  const MbGrant mb = as_on_wire({.id = {7, 20000, 2, Phase::Evaluate},
                                 .want_mobility = true,
                                 .carry = {numbers(1e-3), numbers(2e-3)},
                                 .bias = {numbers(0.1), numbers(0.7)}});
  const MbGrant mb_back = from_message(to_message(mb));
  EXPECT_EQ(mb_back.id.window, 7);
  EXPECT_EQ(mb_back.id.iteration, 2);
  EXPECT_EQ(mb_back.id.phase, Phase::Evaluate);
  EXPECT_TRUE(mb_back.want_mobility);
  EXPECT_EQ(mb_back.carry, mb.carry);
  EXPECT_EQ(mb_back.bias, mb.bias);

  FeGrant fe{.id = {7, 20000}, .drives = {}, .mobility = {}};
  fe.drives.push_back({some_motion().X_WB, some_motion().V_WB, numbers(0.3), numbers(10.1)});
  fe = as_on_wire(fe);
  const FeGrant fe_back = from_message(to_message(fe, 3));
  ASSERT_EQ(fe_back.drives.size(), 1U);
  EXPECT_EQ(fe_back.drives[0].X_WB.p, fe.drives[0].X_WB.p);
  EXPECT_EQ(fe_back.drives[0].X_WB.q.coeffs(), fe.drives[0].X_WB.q.coeffs());
  EXPECT_EQ(fe_back.drives[0].twist_change, fe.drives[0].twist_change);
  EXPECT_EQ(fe_back.drives[0].bias, fe.drives[0].bias);
}

TEST(Messages, RepliesSurviveTheWire) {
  MbReply mb;
  mb.energy = {.kinetic = 1,
               .gravity = 2,
               .joint_elastic = 3,
               .contact_elastic = 4,
               .lost = {{8, 9, 10, 11, 12, 13, 14}},
               .car_work = 6,
               .interface_work = 7,
               .stepping = 5};
  mb.first_contact = true;
  mb.bodies = {some_motion()};
  const MbReply mb_back = from_message(to_message(WindowId{3, 20000}, mb));
  EXPECT_EQ(mb_back.energy.held(), mb.energy.held());
  EXPECT_EQ(mb_back.energy.supplied(), 13);
  EXPECT_EQ(mb_back.energy.lost.J, mb.energy.lost.J);
  EXPECT_EQ(mb_back.energy.stepping, 5);
  EXPECT_TRUE(mb_back.first_contact);
  EXPECT_EQ(mb_back.bodies.at(0).V_WB.w, some_motion().V_WB.w);

  FeReply fe;
  fe.hourglass = 0.5, fe.head_contact_force = 123;
  fe.loads = {{numbers(1e-3), {{1, 2, 3}, {4, 5, 6}}, {1e-6, 0, 0}, {0, 1e-5, 0}}};
  const FeReply fe_back = from_message(to_message(WindowId{3, 20000}, fe));
  EXPECT_EQ(fe_back.hourglass, 0.5);
  EXPECT_EQ(fe_back.head_contact_force, 123);
  EXPECT_EQ(fe_back.loads.at(0).impulse, numbers(1e-3));
  EXPECT_EQ(fe_back.loads.at(0).twist_end.w, Vec3(4, 5, 6));
}

TEST(Messages, MobilityTravelsAsLowerTriangle) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Random(18, 18);
  a = mobility_as_on_wire(a * a.transpose());
  EXPECT_EQ(from_message(to_message(a)), a);
}

TEST(Messages, BlockMassesKeepTheirTensor) {
  Mat3 tensor;
  tensor << 1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 3;
  std::vector<InterfaceBody> bodies(1);
  bodies[0].block = {4.5, {0.1, 0.2, 0.3}, tensor};
  std::vector<InterfaceBody> back(1);
  read_mass(mass_message(bodies), back);
  EXPECT_EQ(back[0].block.mass, 4.5);
  EXPECT_EQ(back[0].block.about_com, tensor);
}

TEST(Messages, GateNamesTheFirstNumberThatIsNotBelievable) {
  MbReply mb;
  mb.bodies = {some_motion(), some_motion()};
  auto good = to_message(WindowId{0, 20000}, mb);
  EXPECT_EQ(problem_in(good), std::nullopt);
  auto bad = good;
  bad.body[1].velocity[2] = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(problem_in(bad));
  EXPECT_NE(problem_in(bad)->find("body 1 velocity[2] = nan"), std::string::npos)
      << *problem_in(bad);
  bad = good;
  bad.body[0].quaternion[0] = 2;
  ASSERT_TRUE(problem_in(bad));
  EXPECT_NE(problem_in(bad)->find("quaternion"), std::string::npos);
  bad = good;
  bad.n_bodies = 9;
  EXPECT_TRUE(problem_in(bad));
  bad = good;
  bad.kinetic = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(problem_in(bad));
}

TEST(Messages, TextForTheWireIsShortAndPrintable) {
  EXPECT_EQ(wire_text("a\nb\tc"), "a b c");
  EXPECT_EQ(wire_text(std::string(2000, 'x')).size(), static_cast<std::size_t>(kMaxTextBytes));
}

}  // namespace
}  // namespace crosswalk
