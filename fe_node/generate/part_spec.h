// Parts, laws and curves of a generated model in SI, before they are written as a deck.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fe_node/deck/material_records.h"
#include "fe_node/generate/mesh_draft.h"

namespace crosswalk::fe::generate {

struct SolidSection {
  double hourglass = 0.05;  ///< coefficient of the stiffness form, on the shear modulus
};
enum class ShellForm { OnePoint, Full, Membrane };  ///< ELFORM 2, 16 and 5
/// Where the nodes of a shell lie: in its middle, on its top (the side of the normal) or bottom.
enum class ShellReference { Middle, Top, Bottom };

struct ShellSection {
  double thickness = 0;  ///< m; of quads without their own
  int points = 5;
  ShellForm form = ShellForm::OnePoint;
  ShellReference reference = ShellReference::Middle;
  /// Position (-1 bottom .. 1 top) and weight of own points through the thickness; empty: Gauss.
  std::vector<std::pair<double, double>> rule;
};
struct TrussSection {
  double area = 0;  ///< m2
};
/// Tension only.
struct CableSection {
  double area = 0;  ///< m2
};
struct SpringSection {};

/// How well a number is known: read in the named source, from the literature by memory, or
/// estimated.
enum class Grade { Source, Literature, Estimate };
const char* mark(Grade grade);  ///< "[S]", "[L]", "[E]"

struct PartSpec {
  int id = 0;
  std::string name;
  double density = 0;  ///< kg/m3; 0 for springs
  MaterialLaw law;     ///< SI
  std::variant<SolidSection, ShellSection, TrussSection, CableSection, SpringSection> section;
  bool is_strand = false;  ///< lines that follow each other share one stretch
  std::string source;      ///< where the numbers come from, in few words
  Grade grade = Grade::Estimate;
};

/// What a curve gives over what.
enum class CurveAxes { ForceOverElongation, StressOverStrain, FactorOverVelocity, FactorOverTime };

struct CurveSpec {
  int id = 0;
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< SI
  CurveAxes axes = CurveAxes::ForceOverElongation;
};

struct PartSetSpec {
  std::string name;
  std::vector<int> parts;
};

struct ModelDraft {
  std::string title;
  MeshDraft mesh;
  std::vector<PartSpec> parts;
  std::vector<CurveSpec> curves;
  std::vector<PartSetSpec> part_sets;

  const PartSpec& part(int id) const;
  PartSpec& part(int id);
};

}  // namespace crosswalk::fe::generate
