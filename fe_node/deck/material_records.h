// Material cards as a keyword deck gives them: one struct per law, user units.
//
// Members follow the card's fields in the field's words; the card's own name stands in the comment.
// Curve fields keep a sign where the manual gives the minus a meaning. A field whose blank or zero
// means a default holds that default. `kNever` stands for the manual's 1e20.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

inline constexpr double kNever = 1e20;

namespace mat {

/// *MAT_ELASTIC (001); with option FLUID: bulk > 0 (VC viscosity, CP cavitation pressure)
struct Elastic {
  double youngs = 0, poisson = 0;
  double axial_damping = 0, bending_damping = 0;  ///< beams only
  bool is_fluid = false;
  double bulk = 0;
  double viscosity_coefficient = 0;  ///< VC
  double cavitation_pressure = kNever;
  bool operator==(const Elastic&) const = default;
};

/// *MAT_PLASTIC_KINEMATIC (003)
struct PlasticKinematic {
  double youngs = 0, poisson = 0, yield = 0, tangent = 0;
  double hardening = 0;            ///< BETA: 0 kinematic, 1 isotropic
  double rate_c = 0, rate_p = 0;   ///< Cowper-Symonds SRC SRP
  double failure_strain = kNever;  ///< FS, effective plastic
  double viscoplastic = 0;         ///< VP
  bool operator==(const PlasticKinematic&) const = default;
};

/// *MAT_VISCOELASTIC (006): G(t) = long + (short - long) exp(-decay t)
struct Viscoelastic {
  double bulk = 0, shear_short = 0, shear_long = 0, decay = 0;
  bool operator==(const Viscoelastic&) const = default;
};

/// *MAT_NULL (009)
struct Null {
  double pressure_cutoff = 0, viscosity = 0;
  double erosion_tension = 0, erosion_compression = 0;
  double youngs = 0, poisson = 0;  ///< for contact stiffness only
  bool operator==(const Null&) const = default;
};

/// *MAT_RIGID (020)
struct Rigid {
  double youngs = 0, poisson = 0;  ///< for contact stiffness only
  double coupling_n = 0, coupling = 0;
  std::string coupling_m;        ///< M or its alias
  double constraint_option = 0;  ///< CMO: 0 none, 1 global axes, -1 local axes
  double constraint_1 = 0;       ///< CON1: as TC (CMO 1), or coordinate system (CMO -1)
  double constraint_2 = 0;       ///< CON2: as RC (CMO 1), or digits 1..6 locked (CMO -1)
  std::array<double, 6> axes{};  ///< LCO or A1..A3, V1..V3: output axes
  bool operator==(const Rigid&) const = default;
};

/// *MAT_PIECEWISE_LINEAR_PLASTICITY (024)
struct PiecewiseLinearPlasticity {
  double youngs = 0, poisson = 0, yield = 0, tangent = 0;
  double failure_strain = kNever;  ///< FAIL; < 0: failure by user routine
  double minimum_step = 0;         ///< TDEL
  double rate_c = 0, rate_p = 0;
  DeckId stress_curve;                       ///< LCSS: curve, or table over strain rate
  DeckId rate_curve;                         ///< LCSR
  double viscoplastic = 0;                   ///< VP
  DeckId failure_curve;                      ///< LCF
  std::array<double, 8> strain{}, stress{};  ///< EPS1..8, ES1..8
  bool operator==(const PiecewiseLinearPlasticity&) const = default;
};

/// *MAT_MOONEY-RIVLIN_RUBBER (027)
struct MooneyRivlin {
  double poisson = 0, a = 0, b = 0, reference = 0;
  double specimen_length = 0, specimen_width = 0, specimen_thickness = 0;
  DeckId curve;
  bool operator==(const MooneyRivlin&) const = default;
};

/// *MAT_LAMINATED_GLASS (032); `layer_is_polymer` F1..: 0 glass, 1 polymer, one per point
struct LaminatedGlass {
  double glass_youngs = 0, glass_poisson = 0, glass_yield = 0, glass_tangent = 0;
  double glass_failure_strain = 0;  ///< EFG, plastic strain at failure
  double polymer_youngs = 0, polymer_poisson = 0, polymer_yield = 0, polymer_tangent = 0;
  std::vector<double> layer_is_polymer;
  bool operator==(const LaminatedGlass&) const = default;
};

/// *MAT_FABRIC (034)
struct Fabric {
  double ea = 0, eb = 0;      ///< Young's moduli along a and b
  double prba = 0, prab = 0;  ///< Poisson ratios
  double gab = 0;
  double compression_off = 0;  ///< CSE 1: no compressive stress
  double liner_youngs = 0, liner_poisson = 0, liner_ratio = 0;
  double damping = 0;
  double axes_option = 0;  ///< AOPT
  double leak_coefficient = 0, leak_area = 0, blocked_area = 0,
         no_compression = 0;                       ///< FLC FAC ELA LNRC
  int form = 0;                                    ///< 0..4, 13, 14, -14 ...
  double leak_law = 0, stress_free_factor = 0;     ///< FVOPT TSRFAC
  double reference_birth = 0, reference_area = 0;  ///< RGBRTH A0REF
  std::array<double, 3> a{}, v{};                  ///< material axes
  std::array<double, 2> cut{};                     ///< X0 X1
  double angle_deg = 0, reference_stress = 0;      ///< BETA ISREFG
  // Curve or table ids of |form| 4, 14, 24; a minus has a meaning of its own in the manual.
  DeckId load_a, load_b, shear;             ///< LCA LCB LCAB
  DeckId unload_a, unload_b, unload_shear;  ///< LCUA LCUB LCUAB
  double reload = 0;                        ///< RL
  // Card of the negative forms.
  DeckId rate_a, rate_b;                   ///< LCAA LCBB
  double hysteresis = 0, rate_cutoff = 0;  ///< H DT
  double coat_youngs = 0, coat_strength = 0, coat_thickness = 0;
  bool operator==(const Fabric&) const = default;
};

/// *MAT_LOW_DENSITY_FOAM (057)
struct LowDensityFoam {
  double youngs = 0;
  DeckId curve;  ///< nominal stress over nominal compression strain
  double tension_cutoff = kNever;
  double hysteresis = 1;  ///< HU
  double decay = 0;       ///< BETA
  double damping = 0;
  double shape = 1;
  double failure = 0, bulk_viscosity = 0, relaxation_youngs = 0, relaxation_decay = 0;
  double contact_stiffness = 0, reference = 0;
  bool operator==(const LowDensityFoam&) const = default;
};

/// *MAT_KELVIN-MAXWELL_VISCOELASTIC (061)
struct KelvinMaxwell {
  double bulk = 0, shear_short = 0, shear_long = 0;
  double decay = 0;          ///< DC
  double formulation = 0;    ///< FO: 0 Maxwell, 1 Kelvin
  double strain_output = 0;  ///< SO
  bool operator==(const KelvinMaxwell&) const = default;
};

/// *MAT_CABLE_DISCRETE_BEAM (071)
struct CableDiscreteBeam {
  double youngs = 0;  ///< > 0; < 0 would be a stiffness
  DeckId curve;       ///< engineering stress over strain; used instead of E
  double initial_force = 0, force_time = 0, ramp_time = 0;
  int extra_card = 0;                                      ///< IREAD > 1
  double output = 0, start_time = 0, length_fraction = 0;  ///< card of IREAD > 1
  double failure_strain = kNever, failure_force = kNever;
  bool operator==(const CableDiscreteBeam&) const = default;
};

/// One term of a Prony series: G(t) += modulus exp(-decay t); bulk likewise
struct PronyTerm {
  double shear = 0, shear_decay = 0, bulk = 0, bulk_decay = 0;
  bool operator==(const PronyTerm&) const = default;
};

/// *MAT_GENERAL_VISCOELASTIC (076)
struct GeneralViscoelastic {
  double bulk = 0;
  double pressure_cutoff = 0, formulation = 0;  ///< PCF EF
  double temperature = 0, shift_a = 0, shift_b = 0;
  DeckId shear_curve, bulk_curve;  ///< fitted by the solver; the terms are then empty
  int shear_terms = 0, bulk_terms = 0;
  double fit_start = 0, bulk_fit_start = 0, ramp = 0, bulk_ramp = 0;
  std::vector<PronyTerm> terms;
  bool operator==(const GeneralViscoelastic&) const = default;
};

/// *MAT_HYPERELASTIC_RUBBER (077_H)
struct HyperelasticRubber {
  double poisson = 0;
  int fitted_terms = 0, prony_terms = 0;                                   ///< N NV
  double shear_friction = 0, friction_stress = 0, reference = 0;           ///< G SIGF REF
  double specimen_length = 0, specimen_width = 0, specimen_thickness = 0;  ///< N > 0
  DeckId curve;
  double data_type = 0;
  DeckId relaxation_curve;
  double fit_start = 0, ramp = 0;
  double c10 = 0, c01 = 0, c11 = 0, c20 = 0, c02 = 0, c30 = 0;
  std::vector<PronyTerm> terms;
  bool operator==(const HyperelasticRubber&) const = default;
};

/// *MAT_OGDEN_RUBBER (077_O)
struct OgdenRubber {
  double poisson = 0;
  int fitted_terms = 0, prony_terms = 0;
  double shear_friction = 0, friction_stress = 0, reference = 0;
  double specimen_length = 0, specimen_width = 0, specimen_thickness = 0;
  DeckId curve;
  double data_type = 0;
  DeckId relaxation_curve;
  double fit_start = 0, ramp = 0;
  std::array<double, 8> mu{}, alpha{};
  int viscous_form = 0;  ///< VFLAG
  std::vector<PronyTerm> terms;
  bool operator==(const OgdenRubber&) const = default;
};

/// *MAT_FU_CHANG_FOAM (083)
struct FuChangFoam {
  double youngs = 0, contact_stiffness = 0, tension_cutoff = kNever, failure = 0, damping = 0;
  DeckId table;
  double bulk_viscosity = 0, rate_option = 0, rate_type = 0, tension_option = 0;
  DeckId viscous_part;
  double rate_averaging = 0, reference = 0, hysteresis = 0;
  std::array<double, 5> d{};  ///< D0 N0 N1 N2 N3
  std::array<double, 6> c{};  ///< C0..C5
  double aij = 0, sij = 0, minimum_rate = 0, maximum_rate = 0, shape = 0;
  double exponent = 0, unloading = 0;  ///< EXPON RIULD
  bool operator==(const FuChangFoam&) const = default;
};

/// *MAT_SOFT_TISSUE (091), _VISCO (092)
struct SoftTissue {
  std::array<double, 5> c{};
  double bulk = 0;              ///< XK
  double straight_stretch = 0;  ///< XLAM, stretch at which the fibres are straight
  double fiber_angle_deg = 0;   ///< FANG
  double initial_stretch = 0;   ///< XLAM0
  double failure_strength = 0, failure_matrix = 0, failure_shear = 0;
  double axes_option = 0;
  std::array<double, 6> axes{};  ///< AX..BZ
  std::array<double, 3> local_fiber{};
  int axes_change = 0;  ///< MACF
  bool is_viscous = false;
  std::array<double, 6> s{}, t{};
  bool operator==(const SoftTissue&) const = default;
};

/// *MAT_SPOTWELD (100)
struct Spotweld {
  double youngs = 0, poisson = 0, yield = 0, hardening = 0, minimum_step = 0, failure_time = 0;
  double failure_strain = 0;
  std::array<double, 6> failure_resultants{};  ///< NRR NRS NRT MRR MSS MTT
  double filter = 0;
  bool operator==(const Spotweld&) const = default;
};

/// *MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM (119)
struct Nonlinear6DofBeam {
  double translational = 0, rotational = 0;  ///< KT KR
  double unloading_option = 0, offset = 0, damping_factor = 0, flag = 0;
  std::array<DeckId, 6> load, unload, damping, damping_scale;  ///< TR TS TT RR RS RT
  std::array<double, 6> tension_failure{}, compression_failure{}, initial{};
  bool operator==(const Nonlinear6DofBeam&) const = default;
};

/// *MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM (121)
struct Nonlinear1DofBeam {
  double stiffness = 0, unloading_option = 0, offset = 0, damping_factor = 0;
  DeckId load, unload, damping, damping_scale;
  double tension_failure = 0, compression_failure = 0, initial = 0;
  bool operator==(const Nonlinear1DofBeam&) const = default;
};

/// *MAT_PLASTICITY_COMPRESSION_TENSION (124)
struct PlasticityCompressionTension {
  double youngs = 0, poisson = 0, rate_c = 0, rate_p = 0;
  double failure_strain = kNever, minimum_step = 0;
  DeckId compression_curve, tension_curve, compression_rate_curve, tension_rate_curve;
  double rate_option = 0;
  DeckId failure_curve;
  double compression_youngs = 0, transition = 0;  ///< EC RPCT
  double mean_compression = 0, mean_tension = 0;  ///< PC PT
  double cutoff_compression = 0, cutoff_tension = 0, cutoff_option = 0;
  double bulk = 0;  ///< K of the viscous terms
  std::vector<PronyTerm> terms;
  bool operator==(const PlasticityCompressionTension&) const = default;
};

/// *MAT_MUSCLE (156), truss
struct Muscle {
  double initial_stretch = 1;   ///< SNO
  double maximum_rate = 0;      ///< SRM
  double peak_stress = 0;       ///< PIS
  double passive_strain = 0;    ///< SSM
  double passive_exponent = 0;  ///< CER
  double damping = 0;           ///< DMP
  double activation = 0;        ///< ALM; < 0: curve of time -ALM
  double stretch_scale = 1;     ///< SFR
  double stretch_factor = 1;    ///< SVS; < 0: curve
  double rate_factor = 1;       ///< SVR; < 0: curve
  double passive_factor = 0;    ///< SSP; < 0: curve, 0: the exponential
  bool operator==(const Muscle&) const = default;
};

/// *MAT_HILL_FOAM (177)
struct HillFoam {
  double bulk = 0, n = 0, damping = 0.05;
  DeckId curve;
  double fit_type = 1;
  DeckId ratio_curve;
  std::array<double, 8> c{}, b{};
  double mullins_r = 0, mullins_m = 0;
  bool operator==(const HillFoam&) const = default;
};

/// *MAT_SIMPLIFIED_RUBBER/FOAM (181)
struct SimplifiedRubber {
  double bulk = 0, damping = 0.1, shear = 0, friction_stress = 0, reference = 0;
  double principal_tension = 0;
  double specimen_length = 0, specimen_width = 0, specimen_thickness = 0;
  DeckId curve;  ///< curve or table over strain rate
  double tension = -1, rate_type = 0, averaging = 0, poisson = 0;  ///< PR/BETA
  DeckId unload_curve;
  double hysteresis = 1, shape = 0, tolerance = 0, viscous = 0, output = 0;
  bool operator==(const SimplifiedRubber&) const = default;
};

/// *MAT_SEATBELT (B01)
struct Seatbelt {
  double length_mass = 0;  ///< MPUL, mass per length
  DeckId load, unload;     ///< LLCID ULCID: force over strain
  double minimum_length = 0;
  double compression_off = 0, damping = 0;
  double youngs = 0;
  bool operator==(const Seatbelt&) const = default;
};

/// *MAT_SPRING_ELASTIC (S01)
struct SpringElastic {
  double stiffness = 0;
  bool operator==(const SpringElastic&) const = default;
};

/// *MAT_DAMPER_VISCOUS (S02)
struct DamperViscous {
  double damping = 0;
  bool operator==(const DamperViscous&) const = default;
};

/// *MAT_SPRING_ELASTOPLASTIC (S03)
struct SpringElastoplastic {
  double stiffness = 0, tangent = 0, yield_force = 0;
  bool operator==(const SpringElastoplastic&) const = default;
};

/// *MAT_SPRING_NONLINEAR_ELASTIC (S04)
struct SpringNonlinearElastic {
  DeckId curve;       ///< force over elongation
  DeckId rate_curve;  ///< scale factor over elongation rate
  bool operator==(const SpringNonlinearElastic&) const = default;
};

/// *MAT_DAMPER_NONLINEAR_VISCOUS (S05)
struct DamperNonlinearViscous {
  DeckId curve;  ///< force over elongation rate
  bool operator==(const DamperNonlinearViscous&) const = default;
};

/// *MAT_SPRING_GENERAL_NONLINEAR (S06)
struct SpringGeneralNonlinear {
  DeckId load, unload;
  double hardening = 0, tension_yield = 0, compression_yield = 0;
  bool operator==(const SpringGeneralNonlinear&) const = default;
};

/// *MAT_SPRING_MAXWELL (S07)
struct SpringMaxwell {
  double stiffness_short = 0, stiffness_long = 0, decay = 0;
  double compression_limit = kNever;  ///< FC, TC
  double tension_limit = kNever;
  double option = 0;  ///< COPT 0 strain, 1 force history
  bool operator==(const SpringMaxwell&) const = default;
};

/// *MAT_SPRING_INELASTIC (S08)
struct SpringInelastic {
  DeckId curve;
  double unload_stiffness = 0;
  double direction = 1;  ///< CTF: 1 tension and compression, -1 tension only
  bool operator==(const SpringInelastic&) const = default;
};

/// *MAT_SPRING_MUSCLE (S15)
struct SpringMuscle {
  double initial_length = 1, maximum_speed = 0;
  double speed_scale = 1;  ///< SV; < 0: curve
  double activation = 0;   ///< A; < 0: curve of time
  double peak_force = 0;
  double tension_length = 1;  ///< TL; < 0: curve
  double tension_speed = 1;   ///< TV; < 0: curve
  double passive = 0;         ///< FPE; < 0: curve, 0: the exponential
  double maximum_length = 0;  ///< LMAX
  double shape = 0;           ///< KSH
  bool operator==(const SpringMuscle&) const = default;
};

/// Any other *MAT_ keyword: its cards as text. Parts may name it; running is refused.
struct Unsupported {
  std::string keyword;
  std::vector<std::string> cards;
  bool operator==(const Unsupported&) const = default;
};

}  // namespace mat

using MaterialLaw =
    std::variant<mat::Elastic, mat::PlasticKinematic, mat::Viscoelastic, mat::Null, mat::Rigid,
                 mat::PiecewiseLinearPlasticity, mat::MooneyRivlin, mat::LaminatedGlass,
                 mat::Fabric, mat::LowDensityFoam, mat::KelvinMaxwell, mat::CableDiscreteBeam,
                 mat::GeneralViscoelastic, mat::HyperelasticRubber, mat::OgdenRubber,
                 mat::FuChangFoam, mat::SoftTissue, mat::Spotweld, mat::Nonlinear6DofBeam,
                 mat::Nonlinear1DofBeam, mat::PlasticityCompressionTension, mat::Muscle,
                 mat::HillFoam, mat::SimplifiedRubber, mat::Seatbelt, mat::SpringElastic,
                 mat::DamperViscous, mat::SpringElastoplastic, mat::SpringNonlinearElastic,
                 mat::DamperNonlinearViscous, mat::SpringGeneralNonlinear, mat::SpringMaxwell,
                 mat::SpringInelastic, mat::SpringMuscle, mat::Unsupported>;

struct Material {
  DeckId id;
  std::string title;
  double density = 0;  ///< RO; 0 for springs, dampers and belts
  MaterialLaw law;
  Source source;
  bool operator==(const Material&) const = default;
};

/// The keyword of a law, "MAT_ELASTIC" and so on.
std::string material_keyword(const Material& material);

/// *MAT_ADD_EROSION: failure criteria on top of a material's law; 0: not used
struct AddErosion {
  DeckId material;
  double exclusion = 0;             ///< EXCL: a value meaning "not used"
  std::array<double, 14> limits{};  ///< MXPRES MNEPS EFFEPS VOLEPS NUMFIP NCS MNPRES SIGP1 SIGVM
                                    ///< MXEPS EPSSH SIGTH IMPULSE FAILTM
  Source source;
  bool operator==(const AddErosion&) const = default;
};

}  // namespace crosswalk::fe
