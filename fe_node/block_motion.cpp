#include "fe_node/block_motion.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

constexpr const char* kDirections[] = {"vx", "vy", "vz", "wx", "wy", "wz"};
constexpr int kFirstCurve = 990001;  // far above those of generated decks
/// A step a little longer than the run's may be taken in a window whose stable step shrinks.
constexpr double kStepReserve = 1.1;
/// Points of the step's curve lie so far inside their window, so that none is met exactly.
constexpr double kInside = 1e-3;

std::string curve_name(const DrivenBlock& block, int direction) {
  return fmt::format("{}_{}.k", block.body, kDirections[direction]);
}

void require(const std::ostream& file, const std::filesystem::path& path) {
  if (!file) throw UserError(Problem{{path.string()}, "block motion", "room to write", "none", {}});
}

}  // namespace

BlockMotionLog::BlockMotionLog(BlockMotionSetup setup, const std::filesystem::path& folder)
    : setup_(std::move(setup)) {
  std::filesystem::create_directories(folder / "driven");
  for (const DrivenBlock& block : setup_.blocks)
    for (int d = 0; d < 6; ++d) curves_.push_back({folder / "driven" / curve_name(block, d), {}});
  curves_.push_back({folder / "driven" / "step.k", {}});
  write_deck(folder);
}

void BlockMotionLog::start_curves() {
  open_curves(std::ios::trunc);
  for (std::size_t i = 0; i < curves_.size(); ++i)
    fmt::print(curves_[i].file, "*KEYWORD\n*DEFINE_CURVE\n{}\n", kFirstCurve + static_cast<int>(i));
}

void BlockMotionLog::open_curves(std::ios::openmode mode) {
  for (Curve& curve : curves_) {
    curve.file = std::ofstream(curve.path, std::ios::out | mode);
    require(curve.file, curve.path);
  }
}

void BlockMotionLog::write_deck(const std::filesystem::path& folder) const {
  const std::filesystem::path path = folder / "driven.k";
  std::ofstream out(path);
  require(out, path);
  const UnitFactors units = unit_factors(setup_.units);
  const Quat q_DW = setup_.X_WD.q.conjugate();
  fmt::print(out,
             "*KEYWORD\n$ crosswalk: unit_system={}\n*TITLE\nHead and neck on the blocks of a "
             "coupled run\n*INCLUDE\n{}\n",
             unit_system_name(setup_.units), setup_.deck);
  int curve = kFirstCurve;
  for (const DrivenBlock& block : setup_.blocks)
    for (int d = 0; d < 6; ++d) {
      const int dof = d < 3 ? d + 1 : d + 2;
      fmt::print(out, "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{},{},0,{},1.0\n*INCLUDE\ndriven/{}\n",
                 block.part, dof, curve++, curve_name(block, d));
    }
  const double scale = std::min(1.0, kStepReserve * setup_.step_scale);
  fmt::print(out, "*INCLUDE\ndriven/step.k\n*CONTROL_TIMESTEP\n0.0,{:.17g},0,0.0,{:.17g},{}\n",
             scale, -setup_.least_step * scale / units.time, curve++);
  const Vec3 gravity = q_DW * setup_.gravity / units.acceleration();
  for (int axis = 0; axis < 3; ++axis) {
    if (gravity[axis] == 0) continue;
    // A base acceleration is felt the other way round.
    fmt::print(out,
               "*DEFINE_CURVE\n{0}\n0.0,{1:.17g}\n{2:.17g},{1:.17g}\n*LOAD_BODY_{3}\n{0},1.0\n",
               curve, -gravity[axis], 1e3 / units.time, "XYZ"[axis]);
    ++curve;
  }
  const Vec3 w = q_DW * setup_.V_WD.w * units.time;
  const Vec3 v = q_DW * setup_.V_WD.v / units.velocity();
  const Vec3 axis = w.norm() > 0 ? Vec3(w.normalized()) : Vec3(0, 0, 1);
  fmt::print(out,
             "*INITIAL_VELOCITY_GENERATION\n0,0,{:.17g},{:.17g},{:.17g},{:.17g}\n"
             "0.0,0.0,0.0,{:.17g},{:.17g},{:.17g},0\n*END\n",
             w.norm(), v.x(), v.y(), v.z(), axis.x(), axis.y(), axis.z());
}

void BlockMotionLog::add(double begin, const WindowLoads& window) {
  if (!curves_.front().file.is_open()) start_curves();
  const UnitFactors units = unit_factors(setup_.units);
  const Quat q_DW = setup_.X_WD.q.conjugate();
  const double length = window.step * window.substeps;
  const double first = begin + 0.5 * window.step, last = begin + length - 0.5 * window.step;
  const auto point = [&](std::size_t curve, double time, double value) {
    fmt::print(curves_[curve].file, "{:.17g},{:.17g}\n", time / units.time, value);
  };
  for (std::size_t k = 0; k < setup_.blocks.size(); ++k) {
    const BlockTwists& block = window.blocks[k];
    for (const auto& [time, V] : {std::pair(first, block.first), std::pair(last, block.last)}) {
      if (time == last && window.substeps < 2) continue;
      const Vec3 v = q_DW * V.v / units.velocity(), w = q_DW * V.w * units.time;
      for (int axis = 0; axis < 3; ++axis) {
        point(6 * k + axis, time, v[axis]);
        point(6 * k + 3 + axis, time, w[axis]);
      }
    }
  }
  const double step = window.step / units.time;
  point(curves_.size() - 1, begin - kInside * length, step);
  point(curves_.size() - 1, begin + (1 - 2 * kInside) * length, step);
}

void BlockMotionLog::continue_after(double time) {
  const double limit = time / unit_factors(setup_.units).time;
  for (Curve& curve : curves_) {
    curve.file.close();
    std::ifstream before(curve.path);
    std::string kept, line;
    for (int number = 0; std::getline(before, line); ++number)
      if (number < 3 || std::stod(line) < limit) kept += line + '\n';
    std::ofstream(curve.path, std::ios::trunc) << kept;
  }
  open_curves(std::ios::app);
}

}  // namespace crosswalk::fe
