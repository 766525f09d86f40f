// Numerical controls of a block: hourglass resistance, bulk viscosity, precision.
#pragma once

namespace crosswalk::fe {

enum class HourglassForm {
  None,
  Viscous,   ///< Flanagan-Belytschko viscous: a = q rho V^(2/3) c / 4 [hallquist2006, 3.2]
  Stiffness  ///< Flanagan-Belytschko stiffness on the SHEAR modulus: k = q mu V (b_iI b_iI)
};

/// With this coefficient the stiffness form gives a cube of an incompressible solid the energy that
/// shear has in its bilinear modes, the integral of mu |grad u|^2 / 2, as eight points would; the
/// trilinear one gets twice its own.
inline constexpr double kOwnHourglass = 2.0 / 9;

/// What an element's own arithmetic is done in, and its history kept in.
enum class Precision { Double, Single };

struct ElementControls {
  HourglassForm hourglass = HourglassForm::Stiffness;
  double hourglass_coefficient = 0.05;
  double quadratic_bulk = 1.5;  ///< [hallquist2006, 3.5]
  double linear_bulk = 0.06;
  Precision precision = Precision::Double;
};

}  // namespace crosswalk::fe
