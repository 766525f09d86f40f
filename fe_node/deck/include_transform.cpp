#include "fe_node/deck/include_transform.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "fe_node/deck/move_deck.h"
#include "fe_node/deck/rescale.h"

namespace crosswalk::fe {

namespace {

void factor(CardIo& io, const char* name, double& value) {
  io.real_or(name, value, 1);
  if (value > 0) return;
  io.problem(name, "a positive factor", fmt::format("{:g}", value));
  value = 1;
}

template <class Value>
void override_with(std::optional<Value>& value, std::optional<Value>& by) {
  if (by) value = std::move(by);
}

void add_control(Control& to, Control& from) {
  if (from.end_time || from.end_cycle != 0) {
    to.end_cycle = from.end_cycle;
    to.minimum_step_ratio = from.minimum_step_ratio;
    to.energy_change = from.energy_change;
    to.mass_change = from.mass_change;
  }
  override_with(to.end_time, from.end_time);
  override_with(to.time_step, from.time_step);
  override_with(to.energy, from.energy);
  override_with(to.hourglass, from.hourglass);
  override_with(to.bulk_viscosity, from.bulk_viscosity);
  override_with(to.contact, from.contact);
  override_with(to.shell, from.shell);
  override_with(to.solid, from.solid);
  override_with(to.accuracy, from.accuracy);
}

template <auto... Lists>
void add_lists(Deck& to, Deck& from) {
  (std::move((from.*Lists).begin(), (from.*Lists).end(), std::back_inserter(to.*Lists)), ...);
}

void add_deck(Deck& to, Deck& from, const IncludeTransform& card, DeckProblems& problems) {
  add_lists<&Deck::nodes, &Deck::solids, &Deck::shells, &Deck::thick_shells, &Deck::beams,
            &Deck::discretes, &Deck::seatbelts, &Deck::masses, &Deck::inertias,
            &Deck::accelerometers, &Deck::parts, &Deck::sections, &Deck::materials, &Deck::erosions,
            &Deck::hourglasses, &Deck::equations_of_state, &Deck::integrations>(to, from);
  add_lists<&Deck::curves, &Deck::curve_functions, &Deck::tables, &Deck::sets, &Deck::segment_sets,
            &Deck::coordinate_nodes, &Deck::coordinate_systems, &Deck::vectors,
            &Deck::spring_orientations, &Deck::boxes, &Deck::transformations>(to, from);
  add_lists<&Deck::spcs, &Deck::prescribed_motions, &Deck::initial_velocities,
            &Deck::nodal_velocities, &Deck::rigid_velocities, &Deck::generated_velocities,
            &Deck::nodal_loads, &Deck::rigid_loads, &Deck::pressures, &Deck::body_loads,
            &Deck::body_load_parts, &Deck::dampings>(to, from);
  add_lists<&Deck::contacts, &Deck::merged_rigid_bodies, &Deck::extra_nodes,
            &Deck::nodal_rigid_bodies, &Deck::joints, &Deck::joint_stiffnesses, &Deck::node_ties,
            &Deck::interpolations, &Deck::rigid_walls>(to, from);
  add_lists<&Deck::databases, &Deck::histories, &Deck::cross_sections, &Deck::unread,
            &Deck::missing_includes>(to, from);
  add_control(to.control, from.control);
  if (to.title.empty()) to.title = from.title;
  if (from.units == UnitSystem::Unknown || card.changes_units()) return;
  if (to.units != UnitSystem::Unknown && to.units != from.units)
    problems.errors.add(to.place(card.source), "*INCLUDE_TRANSFORM",
                        fmt::format("a file in {}", unit_system_name(to.units)),
                        std::string(unit_system_name(from.units)),
                        "give FCTMAS, FCTTIM and FCTLEN");
  to.units = from.units;
}

const Transformation* transformation_of(const Deck& deck, DeckId id) {
  const auto found =
      std::find_if(deck.transformations.begin(), deck.transformations.end(),
                   [id](const Transformation& candidate) { return candidate.id == id; });
  return found == deck.transformations.end() ? nullptr : &*found;
}

}  // namespace

void read_include_transform(CardIo& io, IncludeTransform& card) {
  IdOffsets& offsets = card.offsets;
  if (!io.has_card()) return;
  io.card();
  io.integer("IDNOFF", offsets.node);
  io.integer("IDEOFF", offsets.element);
  io.integer("IDPOFF", offsets.part);
  io.integer("IDMOFF", offsets.material);
  io.integer("IDSOFF", offsets.set);
  io.integer("IDFOFF", offsets.curve);
  io.integer("IDDOFF", offsets.definition);
  if (!io.has_card()) return;
  io.card();
  io.integer("IDROFF", offsets.other);
  io.skip();
  io.text("PREFIX", card.prefix);
  io.text("SUFFIX", card.suffix);
  if (!io.has_card()) return;
  io.card();
  factor(io, "FCTMAS", card.factors.mass);
  factor(io, "FCTTIM", card.factors.time);
  factor(io, "FCTLEN", card.factors.length);
  io.text("FCTTEM", card.temperature);
  io.skip();  // INCOUT1: whether another program writes the file out
  io.text("FCTCHG", card.charge);
  if (!io.has_card()) return;
  io.card();
  io.id("TRANID", card.transformation);
}

void add_transformed(Deck& deck, TransformedInclude include, DeckProblems& problems) {
  const IncludeTransform& card = include.card;
  Deck& content = include.content;
  content.files = deck.files;  // places of its records, for messages
  const Place place = deck.place(card.source);
  const auto say = [&](ProblemList& list, const char* expected, std::string found) {
    list.add(place, "*INCLUDE_TRANSFORM", expected, std::move(found));
  };
  if (!card.prefix.empty() || !card.suffix.empty())
    say(problems.warnings, "", "PREFIX or SUFFIX: titles stay as they are");
  if (!card.temperature.empty() || !card.charge.empty())
    say(problems.warnings, "", "FCTTEM or FCTCHG: there are no temperatures and charges here");
  if (!renumber(content, card.offsets))
    say(problems.errors, "offsets that keep ids within 1 .. 2147483647", "an id outside");
  if (card.changes_units()) rescale(content, card.factors, problems);
  if (card.transformation.given()) {
    const Transformation* transformation = transformation_of(deck, card.transformation);
    if (transformation != nullptr)
      move_deck(content, affine_map(*transformation, deck, problems.errors), problems);
    else
      say(problems.errors, "a *DEFINE_TRANSFORMATION of the including file",
          fmt::format("none with the number {}", card.transformation.value));
  }
  add_deck(deck, content, card, problems);
}

}  // namespace crosswalk::fe
