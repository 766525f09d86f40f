// The same mesh through CalculiX' explicit step (Debian package calculix-ccx): an independent code
// must find the same history. Skipped where `ccx` is not installed.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "fe_node/solve.h"
#include "tests/verification/deck_model.h"

namespace crosswalk::fe {
namespace {

namespace fs = std::filesystem;

struct Sample {
  double time = 0;
  Vec3 u = Vec3::Zero();
};

/// A clamped block of 10 x 1 x 2 bricks that is given the velocity 0.5 (x / L)^2 upwards.
class Cantilever {
 public:
  static constexpr int kX = 10, kY = 1, kZ = 2;
  static constexpr double kEnd = 0.05, kE = 1e7, kNu = 0.3, kDensity = 1000;
  static int id(int i, int j, int k) { return (k * (kY + 1) + j) * (kX + 1) + i + 1; }
  static int tip() { return id(kX, 0, kZ); }

  template <class Visit>
  static void each_node(Visit&& visit) {
    for (int k = 0; k <= kZ; ++k)
      for (int j = 0; j <= kY; ++j)
        for (int i = 0; i <= kX; ++i) visit(id(i, j, k), Vec3(0.1 * i, 0.1 * j, 0.1 * k), 0.1 * i);
  }
  static std::string elements(const char* after_id) {
    std::string text;
    int e = 0;
    for (int k = 0; k < kZ; ++k)
      for (int j = 0; j < kY; ++j)
        for (int i = 0; i < kX; ++i) {
          text += fmt::format("{}{}", ++e, after_id);
          for (int up : {k, k + 1})
            text += fmt::format(",{},{},{},{}", id(i, j, up), id(i + 1, j, up),
                                id(i + 1, j + 1, up), id(i, j + 1, up));
          text += '\n';
        }
    return text;
  }

  static std::string deck() {
    std::string text =
        fmt::format("*SECTION_SOLID\n1,2\n*PART\nbeam\n1,1,1\n*MAT_ELASTIC\n1,{},{},{}\n*NODE\n",
                    kDensity, kE, kNu);
    each_node([&](int n, const Vec3& p, double) { text += node_card(n, p); });
    text += "*ELEMENT_SOLID\n" + elements(",1") + "*INITIAL_VELOCITY_NODE\n";
    each_node([&](int n, const Vec3&, double s) {
      text += fmt::format("{},0,0,{:.9g}\n", n, 0.5 * s * s);
    });
    for (int k = 0; k <= kZ; ++k)
      for (int j = 0; j <= kY; ++j)
        text += fmt::format("*BOUNDARY_SPC_NODE\n{},0,1,1,1\n", id(0, j, k));
    return text + fmt::format(
                      "*CONTROL_BULK_VISCOSITY\n0,0\n*CONTROL_TERMINATION\n{}\n"
                      "*DATABASE_HISTORY_NODE\n{}\n*DATABASE_NODOUT\n2e-4\n",
                      kEnd, tip());
  }

  static std::string input() {
    std::string text = "*NODE,NSET=NALL\n", velocities, root;
    each_node([&](int n, const Vec3& p, double s) {
      text += fmt::format("{},{},{},{}\n", n, p.x(), p.y(), p.z());
      velocities += fmt::format("{},3,{:.9g}\n", n, 0.5 * s * s);
      if (s == 0) root += fmt::format("{},\n", n);
    });
    return text + "*ELEMENT,TYPE=C3D8,ELSET=EALL\n" + elements("") +
           fmt::format(
               "*NSET,NSET=ROOT\n{}*NSET,NSET=TIP\n{}\n*MATERIAL,NAME=M\n*ELASTIC\n{},{}\n"
               "*DENSITY\n{}\n*SOLID SECTION,ELSET=EALL,MATERIAL=M\n*BOUNDARY\nROOT,1,3\n"
               "*INITIAL CONDITIONS,TYPE=VELOCITY\n{}*STEP,INC=10000,NLGEOM\n"
               "*DYNAMIC,EXPLICIT\n1e-4,{},1e-8,1e-4\n*NODE PRINT,NSET=TIP,FREQUENCY=5\n"
               "U\n*END STEP\n",
               root, tip(), kE, kNu, kDensity, velocities, kEnd);
  }
};

/// Blocks of "... time  T" and a line "node ux uy uz".
std::vector<Sample> read_dat(const fs::path& path) {
  std::ifstream file(path);
  std::vector<Sample> out;
  std::string line;
  double time = 0;
  while (std::getline(file, line)) {
    if (const std::size_t at = line.find("time"); at != std::string::npos) {
      time = std::stod(line.substr(at + 4));
      continue;
    }
    std::istringstream fields(line);
    int node = 0;
    Sample s{time, {}};
    if (fields >> node >> s.u[0] >> s.u[1] >> s.u[2]) out.push_back(s);
  }
  return out;
}

std::vector<Sample> read_csv(const fs::path& path) {
  std::ifstream file(path);
  std::vector<Sample> out;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    double node = 0, x = 0;
    Sample s;
    fields >> s.time >> node >> x >> x >> x >> s.u[0] >> s.u[1] >> s.u[2];
    out.push_back(s);
  }
  return out;
}

Vec3 at(const std::vector<Sample>& history, double time) {
  for (std::size_t i = 1; i < history.size(); ++i)
    if (history[i].time >= time) {
      const Sample &a = history[i - 1], &b = history[i];
      return a.u + (time - a.time) / (b.time - a.time) * (b.u - a.u);
    }
  return history.back().u;
}

// A whole swing of the tip, 18 mm. Both bricks average the dilation (C3D8 and formulation 2), the
// steps differ, and so do the laws at 2 % of strain: 2 % of the amplitude.
TEST(FeAgainstCalculix, CantileverSwingsAlike) {
  if (std::system("command -v ccx > /dev/null 2>&1") != 0) GTEST_SKIP() << "ccx is not installed";
  const fs::path folder = fs::path(testing::TempDir()) / "crosswalk_ccx";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "beam.inp") << Cantilever::input();
  std::ofstream(folder / "beam.k") << si_deck(Cantilever::deck());
  const std::string command =
      fmt::format("cd '{}' && OMP_NUM_THREADS=1 ccx -i beam > ccx.log 2>&1", folder.string());
  ASSERT_EQ(std::system(command.c_str()), 0);
  SolveRequest request;
  request.deck = folder / "beam.k";
  request.folder = folder / "ours";
  solve_deck(request);
  const std::vector<Sample> theirs = read_dat(folder / "beam.dat"),
                            ours = read_csv(folder / "ours" / "nodes.csv");
  ASSERT_GT(theirs.size(), 50U);
  ASSERT_GT(ours.size(), 100U);
  double worst = 0, largest = 0;
  for (const Sample& s : theirs) {
    if (s.time > ours.back().time) break;
    worst = std::max(worst, (at(ours, s.time) - s.u).norm());
    largest = std::max(largest, s.u.norm());
  }
  EXPECT_NEAR(theirs.back().time, Cantilever::kEnd, 1e-6);
  EXPECT_GT(largest, 0.015);
  EXPECT_LT(worst, 0.02 * largest);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace crosswalk::fe
