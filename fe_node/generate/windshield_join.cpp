// The windshield beside a head that may be anybody's: numbers clear of every number in use.
#include <algorithm>

#include "common/error.h"
#include "fe_node/generate/deck_export.h"
#include "fe_node/generate/windshield.h"

namespace crosswalk::fe::generate {

namespace {

template <class Record>
int highest(const std::vector<Record>& records) {
  int id = 0;
  for (const Record& record : records) id = std::max(id, record.id.value);
  return id;
}

template <class... Records>
int first_free(const std::vector<Records>&... records) {
  return std::max({highest(records)...}) + 1;
}

template <class Record>
void append(std::vector<Record>& to, std::vector<Record> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Parts (and with them materials) from `first` on.
void number_parts(ModelDraft& draft, int first) {
  const int shift = first - draft.parts.front().id;
  for (PartSpec& part : draft.parts) part.id += shift;
  for (Quad& quad : draft.mesh.quads) quad.part += shift;
  for (PartSetSpec& set : draft.part_sets)
    for (int& part : set.parts) part += shift;
}

DeckId set_titled(const Deck& deck, SetKind kind, const std::string& title) {
  for (const DeckSet& set : deck.sets)
    if (set.kind == kind && set.title == title) return set.id;
  throw UserError(Problem{{}, "part set `" + title + "`", "a *SET_PART of that title", "none", {}});
}

}  // namespace

void join_windshield(Deck& deck, const WindshieldSpec& spec, const std::string& head_surface,
                     double friction) {
  ModelDraft draft = build_windshield(spec);
  number_parts(draft, first_free(deck.parts, deck.materials));
  const DeckNumbers numbers{
      .node = first_free(deck.nodes),
      .element = first_free(deck.solids, deck.shells, deck.thick_shells, deck.beams, deck.discretes,
                            deck.seatbelts, deck.masses),
      .section = first_free(deck.sections, deck.integrations),
      .hourglass = first_free(deck.hourglasses),
      .set = first_free(deck.sets)};
  Deck pane = to_deck(draft, spec.units, numbers);
  append(deck.nodes, std::move(pane.nodes));
  append(deck.shells, std::move(pane.shells));
  append(deck.parts, std::move(pane.parts));
  append(deck.materials, std::move(pane.materials));
  append(deck.sections, std::move(pane.sections));
  append(deck.integrations, std::move(pane.integrations));
  append(deck.sets, std::move(pane.sets));

  Contact contact = contact_named("AUTOMATIC_SURFACE_TO_SURFACE");
  contact.id = DeckId(first_free(deck.contacts));
  contact.title = kWindshieldContact;
  contact.slave = {.id = set_titled(deck, SetKind::Part, head_surface),
                   .kind = SurfaceKind::PartSet};
  contact.master = {.id = set_titled(deck, SetKind::Part, "windshield_contact"),
                    .kind = SurfaceKind::PartSet};
  contact.static_friction = contact.dynamic_friction = friction;
  contact.damping_percent = 20;  // of critical; the usual value of such contacts [hallquist2006]
  contact.card_a = ContactCardA{.soft = 1};
  deck.contacts.push_back(contact);
}

}  // namespace crosswalk::fe::generate
