// *CONTACT cards between meshed surfaces to contact specifications.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fe_node/deck/part_table.h"
#include "fe_node/model_builder/build_context.h"
#include "fe_node/model_builder/law_stage.h"

namespace crosswalk::fe {
namespace {

/// K of a part's material for the penalty stiffness; steel's where the law has no modulus.
double contact_bulk_modulus(BuildContext& c, const Part& part) {
  constexpr double kFallback = 1.7e11;
  const double stress = c.units.stress();
  const Material* material = c.material_of(part);
  if (part.composite && !part.composite->layers.empty())
    if (const auto it = c.materials.find(part.composite->layers.front().material);
        it != c.materials.end())
      material = it->second;
  if (material == nullptr) return kFallback;
  return std::visit(
      [&](const auto& law) -> double {
        auto of = [&](double E, double nu) {
          return E > 0 ? stress * E / (3 * (1 - 2 * std::min(nu, 0.49))) : kFallback;
        };
        if constexpr (requires {
                        law.youngs;
                        law.poisson;
                      })
          return of(law.youngs, law.poisson);
        if constexpr (requires { law.glass_youngs; })
          return of(law.glass_youngs, law.glass_poisson);
        if constexpr (requires { law.bulk; })
          if (law.bulk > 0) return law.bulk * stress;
        if constexpr (requires { law.youngs; }) return of(law.youngs, 0);
        if constexpr (requires { law.ea; }) return of(law.ea, 0.3);
        if constexpr (requires {
                        law.mu;
                        law.alpha;
                      }) {
          double shear = 0;
          for (std::size_t i = 0; i < law.mu.size(); ++i) shear += 0.5 * law.mu[i] * law.alpha[i];
          return bulk_from_poisson(shear * stress, std::min(law.poisson, 0.499));
        }
        return kFallback;
      },
      material->law);
}

double section_thickness(BuildContext& c, const Part& part) {
  if (part.composite) {
    double sum = 0;
    for (const CompositeLayer& layer : part.composite->layers) sum += layer.thickness;
    return sum * c.units.length;
  }
  const Section* section = c.section_of(part);
  const auto* shell = section == nullptr ? nullptr : std::get_if<SectionShell>(&section->law);
  return shell == nullptr ? 0 : shell->thickness[0] * c.units.length;
}

class MeshContactStage {
 public:
  MeshContactStage(BuildContext& context, const Contact& contact) : c_(context), card_(contact) {}

  void run() {
    MeshContactSpec spec;
    spec.name = card_.title.empty() ? fmt::format("contact {}", card_.id.value) : card_.title;
    spec.name.erase(spec.name.find_last_not_of(" \t") + 1);
    spec.settings = settings();
    switch (card_.kind) {
      case ContactKind::SingleSurface:
      case ContactKind::General:
        spec.kind = MeshContactSpec::Kind::Single;
        spec.first = surface(card_.slave);
        break;
      case ContactKind::SurfaceToSurface:
        spec.kind = MeshContactSpec::Kind::Surfaces;
        spec.first = surface(card_.slave);
        spec.second = surface(card_.master);
        break;
      case ContactKind::OneWaySurfaceToSurface:
      case ContactKind::NodesToSurface:
        spec.kind = MeshContactSpec::Kind::NodesToSurface;
        spec.first = surface(card_.slave);
        spec.second = surface(card_.master);
        break;
      case ContactKind::TiedNodesToSurface:
      case ContactKind::TiedSurfaceToSurface:
      case ContactKind::TiedShellEdgeToSurface:
        spec.kind = MeshContactSpec::Kind::Tied;
        spec.first = surface(card_.slave);
        spec.second = surface(card_.master);
        break;
      case ContactKind::ForceTransducer:
        return;
      case ContactKind::Unsupported:
        c_.problem(card_.source, "*CONTACT_" + card_.keyword, "a contact that can be run",
                   "one that cannot");
        return;
    }
    if (card_.is_tiebreak && !add_tiebreak(spec)) return;
    if (c_.problem_count > 0) return;
    std::optional<MeshContactSpec> edges;
    if (asks_for_edges()) edges = edge_contact(spec);
    c_.built.mesh_contacts.push_back(std::move(spec));
    if (edges) c_.built.mesh_contacts.push_back(std::move(*edges));
  }

 private:
  PenaltySettings settings() {
    PenaltySettings s;
    const std::optional<ContactControl>& control = c_.deck.control.contact;
    const double scale = control && control->stiffness_scale > 0 ? control->stiffness_scale : 0.1;
    s.stiffness_scale = scale * (card_.slave.stiffness_scale > 0 ? card_.slave.stiffness_scale : 1);
    s.static_friction = std::max(card_.static_friction, card_.dynamic_friction);
    s.dynamic_friction = card_.dynamic_friction;
    s.friction_decay = card_.decay / c_.units.velocity();
    // a decay of zero keeps the static coefficient, as the manual has it
    if (card_.decay == 0 && card_.static_friction > 0) s.dynamic_friction = s.static_friction;
    s.damping_ratio = 0.01 * card_.damping_percent;
    s.birth = card_.birth * c_.units.time;
    s.death = card_.death > 0 && card_.death < kNever ? card_.death * c_.units.time : 1e300;
    if (card_.slave.thickness_scale > 0) s.thickness_scale = card_.slave.thickness_scale;
    if (card_.card_a && card_.card_a->soft > 0) {
      s.soft_scale = card_.card_a->soft_scale > 0 ? card_.card_a->soft_scale : 0.1;
      if (card_.card_a->soft == 2)
        c_.note(
            fmt::format("contact {}: segment-based (SOFT 2) is computed node to segment with "
                        "soft constraint (SOFT 1)",
                        card_.id.value));
    }
    return s;
  }

  /// Edges meet edges in *CONTACT_AUTOMATIC_GENERAL and, of surfaces, with SOFT 2 and DEPTH 5.
  bool asks_for_edges() const {
    if (card_.kind == ContactKind::General) return true;
    const bool is_penalty =
        card_.kind == ContactKind::SingleSurface || card_.kind == ContactKind::SurfaceToSurface;
    return is_penalty && card_.card_a && card_.card_a->soft == 2 && card_.card_a->depth >= 5;
  }

  std::optional<MeshContactSpec> edge_contact(const MeshContactSpec& surfaces) {
    MeshContactSpec spec;
    spec.name = surfaces.name + ", edges";
    spec.kind = MeshContactSpec::Kind::Edges;
    spec.settings = surfaces.settings;
    spec.first = surfaces.first;
    spec.first_edges = edges_of(card_.slave, surfaces.first);
    if (surfaces.kind == MeshContactSpec::Kind::Surfaces)
      spec.second_edges = edges_of(card_.master, surfaces.second);
    const bool needs_two = surfaces.kind == MeshContactSpec::Kind::Surfaces;
    if (spec.first_edges.empty() || (needs_two && spec.second_edges.empty())) return std::nullopt;
    return spec;
  }

  /// Free edges of the side's shells; in *CONTACT_AUTOMATIC_GENERAL its beams too.
  std::vector<ContactEdge> edges_of(const ContactSide& side, const ContactSurface& surface) {
    std::vector<ContactEdge> edges = free_edges(surface);
    if (card_.kind != ContactKind::General) return edges;
    for (int p : parts_of(side)) {
      const Part& part = c_.deck.parts[p];
      const Section* section = c_.section_of(part);
      const auto* beam = section == nullptr ? nullptr : std::get_if<SectionBeam>(&section->law);
      if (beam == nullptr) continue;
      const double section_area = beam->formulation == 6 ? beam->cable_area : beam_area(*beam);
      const double area = section_area * c_.units.length * c_.units.length;
      const auto more = line_edges(c_.mesh(), p, area, contact_bulk_modulus(c_, part));
      edges.insert(edges.end(), more.begin(), more.end());
    }
    return edges;
  }

  /// Card 4 of the tiebreak kinds; false when it asks for what cannot be run.
  bool add_tiebreak(MeshContactSpec& spec) {
    const std::string who = "*CONTACT_" + card_.keyword;
    const auto refuse = [&](std::string expected, std::string found) {
      c_.problem(card_.source, who, std::move(expected), std::move(found));
      return false;
    };
    if (spec.kind != MeshContactSpec::Kind::Surfaces &&
        spec.kind != MeshContactSpec::Kind::NodesToSurface)
      return refuse("a tiebreak of a surface or nodes with a surface", "another kind");
    const std::array<double, 8>& f = card_.special;
    TiebreakLimits limits;
    std::size_t at = 0;
    if (card_.is_automatic) {
      if (f[0] != 2)
        return refuse("OPTION 2 (tied until a stress limit)", fmt::format("{:g}", f[0]));
      if (f[3] != 0) return refuse("PARAM 0", fmt::format("{:g}", f[3]));
      at = 1;
    }
    limits.is_stress = card_.is_automatic || card_.keyword.find("NODES") == std::string::npos;
    const double unit = limits.is_stress ? c_.units.stress() : c_.units.force();
    limits.normal = f[at] * unit;
    limits.shear = f[at + 1] * unit;
    if (!limits.is_stress) {
      if (f[2] > 0) limits.normal_exponent = f[2];
      if (f[3] > 0) limits.shear_exponent = f[3];
    } else if (!card_.is_automatic && f[2] != 0) {
      return refuse("no curve of stress over gap (TBLCID)", fmt::format("{:g}", f[2]));
    }
    if (limits.normal < 0 || limits.shear < 0 || limits.normal + limits.shear == 0)
      return refuse("a positive limit of pull or shear", "none");
    if (limits.is_stress && spec.first.facets.empty())
      return refuse("a surface on the slave side, for stress limits", "nodes");
    spec.settings.tiebreak = limits;
    return true;
  }

  std::vector<int> parts_of(const ContactSide& side) {
    switch (side.kind) {
      case SurfaceKind::Part: {
        const auto found = c_.part_index.find(side.id);
        if (found != c_.part_index.end()) return {found->second};
        c_.problem(card_.source, "*CONTACT_" + card_.keyword, "a part of the deck",
                   std::to_string(side.id.value));
        return {};
      }
      case SurfaceKind::PartSet:
        if (side.id.given()) return c_.part_set(side.id, card_.source);
        return all_parts({});
      case SurfaceKind::ExemptedPartSet:
        return all_parts(c_.part_set(side.id, card_.source));
      default:
        return all_parts({});
    }
  }

  std::vector<int> all_parts(const std::vector<int>& but) const {
    std::vector<int> parts;
    for (int p = 0; p < static_cast<int>(c_.deck.parts.size()); ++p)
      if (std::find(but.begin(), but.end(), p) == but.end()) parts.push_back(p);
    return parts;
  }

  ContactSurface surface(const ContactSide& side) {
    const bool is_all = side.kind == SurfaceKind::All || !side.id.given();
    if (side.kind == SurfaceKind::NodeSet && !is_all)
      return ContactSurface::of_nodes(c_.node_set(side.id, card_.source));
    if (side.kind == SurfaceKind::SegmentSet && !is_all) return segments(side);
    if (side.kind == SurfaceKind::ShellSet) {
      c_.problem(card_.source, "*CONTACT_" + card_.keyword,
                 "a side given by parts, a part set, nodes or segments", "a shell set");
      return {};
    }
    std::vector<ContactPart> parts;
    for (int p : parts_of(side)) parts.push_back(contact_part(p));
    ContactSurface found =
        surface_of(c_.mesh(), parts, card_.is_eroding ? InnerFaces::Kept : InnerFaces::Left);
    if (side.thickness > 0) set_thickness(found, side.thickness * c_.units.length);
    return found;
  }

  ContactPart contact_part(int index) {
    const Part& part = c_.deck.parts[index];
    ContactPart out;
    out.part = index;
    out.bulk_modulus = contact_bulk_modulus(c_, part);
    out.thickness = section_thickness(c_, part);
    if (!c_.shell_thickness.empty())
      for (ElementKind kind : {ElementKind::Quad4, ElementKind::Tri3}) {
        const ElementTable& table = c_.mesh().table(kind);
        for (int e = 0; e < table.size(); ++e) {
          if (table.part[e] != index) continue;
          const auto found = c_.shell_thickness.find(table.id[e]);
          out.per_element.push_back(found == c_.shell_thickness.end() ? out.thickness
                                                                      : found->second);
        }
      }
    if (part.contact && part.contact->thickness > 0)
      out.thickness = part.contact->thickness * c_.units.length;
    return out;
  }

  static void set_thickness(ContactSurface& surface, double thickness) {
    for (ContactFacet& facet : surface.facets)
      if (facet.is_two_sided) facet.half_thickness = 0.5 * thickness;
    surface.collect_nodes();
  }

  /// The facets of all parts that a segment set names, turned as the set has them.
  ContactSurface segments(const ContactSide& side) {
    const auto set = std::find_if(c_.deck.segment_sets.begin(), c_.deck.segment_sets.end(),
                                  [&](const SegmentSet& s) { return s.id == side.id; });
    if (set == c_.deck.segment_sets.end() || !set->general.empty()) {
      c_.problem(card_.source, "*CONTACT_" + card_.keyword, "a list of segments of the deck",
                 std::to_string(side.id.value));
      return {};
    }
    std::vector<std::array<int, 4>> wanted;
    for (const auto& segment : set->segments) {
      std::array<int, 4> key{};
      for (int i = 0; i < 4; ++i) key[i] = c_.node(segment[i], set->source, "*SET_SEGMENT");
      std::sort(key.begin(), key.end());
      wanted.push_back(key);
    }
    std::sort(wanted.begin(), wanted.end());
    std::vector<ContactPart> parts;
    for (int p : all_parts({})) parts.push_back(contact_part(p));
    ContactSurface found = surface_of(c_.mesh(), parts);
    std::erase_if(found.facets, [&](const ContactFacet& facet) {
      std::array<int, 4> key = facet.node;
      std::sort(key.begin(), key.end());
      return !std::binary_search(wanted.begin(), wanted.end(), key);
    });
    if (found.facets.size() < wanted.size())
      c_.note(fmt::format("contact {}: {} of {} segments of set {} are no element faces",
                          card_.id.value, wanted.size() - found.facets.size(), wanted.size(),
                          side.id.value));
    found.collect_nodes();
    return found;
  }

  BuildContext& c_;
  const Contact& card_;
};

}  // namespace

void build_mesh_contacts(BuildContext& context) {
  for (const Contact& contact : context.deck.contacts) MeshContactStage(context, contact).run();
}

}  // namespace crosswalk::fe
