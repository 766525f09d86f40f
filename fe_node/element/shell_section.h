// Shell sections: thickness, layers and their points through the thickness.
//
// Positions are measured from the surface of the nodes in units of the thickness: where that is the
// mid-surface, -1/2 at the bottom and +1/2 at the top (the side the normal points to, nodes counted
// anticlockwise); weights are shares of the thickness and sum to one.
#pragma once

#include <variant>
#include <vector>

#include "fe_node/material/shell_glass.h"
#include "fe_node/material/shell_law.h"
#include "fe_node/material/shell_membrane.h"
#include "fe_node/material/shell_plastic.h"
#include "fe_node/material/shell_viscoelastic.h"

namespace crosswalk::fe {

/// All laws a shell can have. To add one: its header here, and nothing else.
using ShellLaw =
    std::variant<ShellElastic, ShellPlastic, ShellGlass, ShellViscoelastic, ShellTensionSheet>;

enum class ShellTheory {
  Bending,  ///< Mindlin-Reissner, nodes with rotations
  Membrane  ///< in-plane forces only, nodes without rotations
};

/// Does the thickness follow the normal strain, or stay as given?
enum class ShellThinning { Fixed, FollowsStrain };

/// Points of a quadrilateral in its plane; a triangle has one.
enum class ShellIntegration {
  OnePoint,  ///< Belytschko-Tsay, with hourglass control
  Full       ///< 2 x 2, needs none
};

struct ShellPoint {
  double position = 0;
  double weight = 1;
};

struct ShellLayer {
  ShellLaw law;
  std::vector<ShellPoint> points;
};

struct ShellSection {
  double thickness = 0;  ///< m
  ShellTheory theory = ShellTheory::Bending;
  ShellThinning thinning = ShellThinning::Fixed;
  ShellIntegration integration = ShellIntegration::OnePoint;
  double shear_factor = 5.0 / 6.0;
  std::vector<ShellLayer> layers;  ///< from the bottom

  double density() const;         ///< kg/m3, mean over the thickness
  double youngs_modulus() const;  ///< Pa, likewise
};

/// Lets the nodes lie at that position of the section instead of in its middle (0), e.g. on its top
/// (1/2). Stretching then bends and bending stretches.
void move_reference(ShellSection& section, double position);

/// One law over the whole thickness. Gauss points (1..5) sample inside, Lobatto points (3..10 here
/// as trapezoid beyond 5) include the faces.
enum class ThicknessRule { Gauss, Lobatto };
ShellSection uniform_section(ShellLaw law, double thickness, int points,
                             ThicknessRule rule = ThicknessRule::Gauss);
ShellSection membrane_section(ShellLaw law, double thickness);

struct Ply {
  ShellLaw law;
  double thickness = 0;  ///< m
  int points = 1;        ///< Gauss points inside the ply
};
/// Bonded plies, plane sections stay plane. The shear factor is lowered so that the transverse
/// shear stiffness is that of the plies in series, which a soft interlayer governs.
ShellSection laminate(const std::vector<Ply>& plies);

/// That of transverse shear in series over the layers, at most 5/6.
double series_shear_factor(const ShellSection& section);

double density_of(const ShellLaw& law);

}  // namespace crosswalk::fe
