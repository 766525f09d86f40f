// The *MAT_ keywords, by name and by number, and their laws.
#include <algorithm>

#include "fe_node/deck/cards_material.h"
#include "fe_node/deck/keyword_table.h"
#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {

struct LawEntry {
  std::vector<std::string_view> names;  ///< the first is the one written
  MaterialLaw (*make)();
};

template <class Law>
MaterialLaw make() {
  return Law{};
}
MaterialLaw make_fluid() { return mat::Elastic{.is_fluid = true}; }
MaterialLaw make_viscous_tissue() { return mat::SoftTissue{.is_viscous = true}; }

const std::vector<LawEntry>& laws() {
  static const std::vector<LawEntry> kLaws{
      {{"MAT_ELASTIC", "MAT_001"}, make<mat::Elastic>},
      {{"MAT_ELASTIC_FLUID", "MAT_001_FLUID"}, make_fluid},
      {{"MAT_PLASTIC_KINEMATIC", "MAT_003"}, make<mat::PlasticKinematic>},
      {{"MAT_VISCOELASTIC", "MAT_006"}, make<mat::Viscoelastic>},
      {{"MAT_NULL", "MAT_009"}, make<mat::Null>},
      {{"MAT_RIGID", "MAT_020"}, make<mat::Rigid>},
      {{"MAT_PIECEWISE_LINEAR_PLASTICITY", "MAT_024"}, make<mat::PiecewiseLinearPlasticity>},
      {{"MAT_MOONEY-RIVLIN_RUBBER", "MAT_027"}, make<mat::MooneyRivlin>},
      {{"MAT_LAMINATED_GLASS", "MAT_032"}, make<mat::LaminatedGlass>},
      {{"MAT_FABRIC", "MAT_034"}, make<mat::Fabric>},
      {{"MAT_LOW_DENSITY_FOAM", "MAT_057"}, make<mat::LowDensityFoam>},
      {{"MAT_KELVIN-MAXWELL_VISCOELASTIC", "MAT_061"}, make<mat::KelvinMaxwell>},
      {{"MAT_CABLE_DISCRETE_BEAM", "MAT_071"}, make<mat::CableDiscreteBeam>},
      {{"MAT_GENERAL_VISCOELASTIC", "MAT_076"}, make<mat::GeneralViscoelastic>},
      {{"MAT_HYPERELASTIC_RUBBER", "MAT_077_H"}, make<mat::HyperelasticRubber>},
      {{"MAT_OGDEN_RUBBER", "MAT_077_O"}, make<mat::OgdenRubber>},
      {{"MAT_FU_CHANG_FOAM", "MAT_083"}, make<mat::FuChangFoam>},
      {{"MAT_SOFT_TISSUE", "MAT_091"}, make<mat::SoftTissue>},
      {{"MAT_SOFT_TISSUE_VISCO", "MAT_092"}, make_viscous_tissue},
      {{"MAT_SPOTWELD", "MAT_100"}, make<mat::Spotweld>},
      {{"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "MAT_119"}, make<mat::Nonlinear6DofBeam>},
      {{"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", "MAT_121"}, make<mat::Nonlinear1DofBeam>},
      {{"MAT_PLASTICITY_COMPRESSION_TENSION", "MAT_124"}, make<mat::PlasticityCompressionTension>},
      {{"MAT_MUSCLE", "MAT_156"}, make<mat::Muscle>},
      {{"MAT_HILL_FOAM", "MAT_177"}, make<mat::HillFoam>},
      {{"MAT_SIMPLIFIED_RUBBER/FOAM", "MAT_SIMPLIFIED_RUBBER", "MAT_181"},
       make<mat::SimplifiedRubber>},
      {{"MAT_SEATBELT", "MAT_B01"}, make<mat::Seatbelt>},
      {{"MAT_SPRING_ELASTIC", "MAT_S01"}, make<mat::SpringElastic>},
      {{"MAT_DAMPER_VISCOUS", "MAT_S02"}, make<mat::DamperViscous>},
      {{"MAT_SPRING_ELASTOPLASTIC", "MAT_S03"}, make<mat::SpringElastoplastic>},
      {{"MAT_SPRING_NONLINEAR_ELASTIC", "MAT_S04"}, make<mat::SpringNonlinearElastic>},
      {{"MAT_DAMPER_NONLINEAR_VISCOUS", "MAT_S05"}, make<mat::DamperNonlinearViscous>},
      {{"MAT_SPRING_GENERAL_NONLINEAR", "MAT_S06"}, make<mat::SpringGeneralNonlinear>},
      {{"MAT_SPRING_MAXWELL", "MAT_S07"}, make<mat::SpringMaxwell>},
      {{"MAT_SPRING_INELASTIC", "MAT_S08"}, make<mat::SpringInelastic>},
      {{"MAT_SPRING_MUSCLE", "MAT_S15"}, make<mat::SpringMuscle>},
  };
  return kLaws;
}

bool is_same_kind(const MaterialLaw& a, const MaterialLaw& b) {
  if (a.index() != b.index()) return false;
  if (const auto* elastic = std::get_if<mat::Elastic>(&a))
    return elastic->is_fluid == std::get<mat::Elastic>(b).is_fluid;
  if (const auto* tissue = std::get_if<mat::SoftTissue>(&a))
    return tissue->is_viscous == std::get<mat::SoftTissue>(b).is_viscous;
  return true;
}

void read_material(KeywordBlock& block) {
  Material material;
  const auto entry = std::find_if(laws().begin(), laws().end(), [&](const LawEntry& law) {
    return std::find(law.names.begin(), law.names.end(), block.base) != law.names.end();
  });
  material.law = entry->make();
  material.source = block.io.keyword_source();
  block.read_title(material.title);
  std::visit([&](auto& law) { cards(block.io, material, law); }, material.law);
  block.deck.materials.push_back(std::move(material));
}

void erosion_cards(CardIo& io, AddErosion& erosion) {
  constexpr std::array<const char*, 14> kNames{"MXPRES", "MNEPS",  "EFFEPS",  "VOLEPS", "NUMFIP",
                                               "NCS",    "MNPRES", "SIGP1",   "SIGVM",  "MXEPS",
                                               "EPSSH",  "SIGTH",  "IMPULSE", "FAILTM"};
  io.card();
  io.id("MID", erosion.material);
  io.real("EXCL", erosion.exclusion);
  for (std::size_t i = 0; i < 6; ++i) io.real(kNames[i], erosion.limits[i]);
  io.card();
  for (std::size_t i = 6; i < 14; ++i) io.real(kNames[i], erosion.limits[i]);
}

void read_erosion(KeywordBlock& block) {
  AddErosion erosion;
  std::string title;
  block.read_title(title);
  erosion_cards(block.io, erosion);
  erosion.source = block.io.keyword_source();
  block.deck.erosions.push_back(erosion);
}

const std::vector<KeywordEntry>& entries() {
  static const std::vector<KeywordEntry> kEntries = [] {
    std::vector<KeywordEntry> out;
    for (const LawEntry& law : laws())
      for (const std::string_view name : law.names) out.push_back({name, {"TITLE"}, read_material});
    out.push_back({"MAT_ADD_EROSION", {"TITLE"}, read_erosion});
    return out;
  }();
  return kEntries;
}

}  // namespace

std::span<const KeywordEntry> material_keywords() { return entries(); }

std::string material_keyword(const Material& material) {
  if (const auto* unsupported = std::get_if<mat::Unsupported>(&material.law))
    return unsupported->keyword;
  for (const LawEntry& law : laws())
    if (is_same_kind(law.make(), material.law)) return std::string(law.names.front());
  return "MAT_UNKNOWN";
}

void read_unsupported_material(KeywordBlock& block, const std::string& keyword) {
  Material material;
  material.source = block.io.keyword_source();
  block.read_title(material.title);
  mat::Unsupported& law = material.law.emplace<mat::Unsupported>();
  law.keyword = keyword;
  const std::string_view first = block.io.next_line();
  const std::size_t end = std::min<std::size_t>(first.find(','), CardIo::kWidth);
  if (const auto id = parse_integer(first.substr(0, end))) material.id = DeckId(*id);
  cards(block.io, material, law);
  block.deck.materials.push_back(std::move(material));
}

void write_materials(CardWriter& out, const Deck& deck) {
  for (Material material : deck.materials) {
    out.keyword_with_title(material_keyword(material), material.title);
    std::visit([&](auto& law) { cards(out, material, law); }, material.law);
  }
  for (AddErosion erosion : deck.erosions) {
    out.keyword("MAT_ADD_EROSION");
    erosion_cards(out, erosion);
  }
}

}  // namespace crosswalk::fe
