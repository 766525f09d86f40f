#include "mb_node/front_contact.h"

#include <algorithm>
#include <cstdlib>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

const PanelTouch* touch_of(std::span<const PanelTouch> touches, int panel) {
  for (const PanelTouch& t : touches) {
    if (t.panel == panel) return &t;
  }
  return nullptr;
}

/// The touch next to a panel along the profile; null when there is none.
const PanelTouch* nearest(std::span<const PanelTouch> touches, int panel) {
  const PanelTouch* best = nullptr;
  for (const PanelTouch& t : touches) {
    if (best == nullptr || std::abs(t.panel - panel) < std::abs(best->panel - panel)) best = &t;
  }
  return best;
}

/// Starts a contact, or lets a lasting one take over the energy of a neighbour; returns what it
/// could not hold.
double take_over(const ContactLaw& law, const PanelTouch& touch, double energy,
                 PanelContact& contact) {
  const double held = contact.is_touching ? law.stored_energy(contact.pressed, contact.deepest) : 0;
  const double x = std::max(contact.pressed,
                            law.penetration_holding(held + energy, contact.deepest, touch.depth));
  contact.is_touching = true;
  contact.pressed = x;
  contact.unpressed = touch.depth - x;
  contact.deepest = std::max(contact.deepest, x);
  return held + energy - law.stored_energy(x, contact.deepest);
}

}  // namespace

FrontPanels front_panels(const VehicleFront& front, const std::vector<FrontChain>& chains) {
  FrontPanels panels;
  panels.of_facet.assign(front.facets.size(), -1);
  for (const FrontChain& chain : chains) {
    int component = -1;
    for (const int facet : chain.facets) {
      if (front.facet_component[facet] != component) {
        component = front.facet_component[facet];
        panels.component.push_back(component);
      }
      panels.of_facet[facet] = panels.count() - 1;
    }
  }
  return panels;
}

FrontLosses press_in(std::span<const PanelTouch> touches, std::span<const ContactLaw* const> laws,
                     double dt, std::span<PanelContact> contacts) {
  FrontLosses losses;
  // Lasting contacts follow the motion; an overlap that shrinks takes the unpressed part along.
  for (const PanelTouch& touch : touches) {
    PanelContact& contact = contacts[touch.panel];
    if (!contact.is_touching) continue;
    contact.unpressed = std::min(contact.unpressed, touch.depth);
    contact.pressed = touch.depth - contact.unpressed;
  }
  // New contacts start with what this substep's motion has pressed in ...
  for (const PanelTouch& touch : touches) {
    PanelContact& contact = contacts[touch.panel];
    if (contact.is_touching) continue;
    const double moved = std::clamp(touch.approach * dt, 0.0, touch.depth);
    const double dent = std::min(touch.depth, laws[touch.panel]->permanent(contact.deepest));
    contact.is_touching = true;
    contact.pressed = std::max(moved, dent);
    contact.unpressed = touch.depth - contact.pressed;
  }
  for (const PanelTouch& touch : touches) {
    PanelContact& contact = contacts[touch.panel];
    if (contact.pressed <= contact.deepest) continue;
    losses.hysteresis += laws[touch.panel]->lost_energy(contact.pressed) -
                         laws[touch.panel]->lost_energy(contact.deepest);
    contact.deepest = contact.pressed;
  }
  // ... and with what the panels left behind have stored.
  for (int panel = 0; panel < static_cast<int>(contacts.size()); ++panel) {
    PanelContact& contact = contacts[panel];
    if (!contact.is_touching || touch_of(touches, panel) != nullptr) continue;
    const double energy = laws[panel]->stored_energy(contact.pressed, contact.deepest);
    contact.is_touching = false;
    contact.pressed = contact.unpressed = 0;
    if (!(energy > 0)) continue;
    const PanelTouch* heir = nearest(touches, panel);
    losses.left += heir == nullptr
                       ? energy
                       : take_over(*laws[heir->panel], *heir, energy, contacts[heir->panel]);
  }
  return losses;
}

}  // namespace crosswalk::mb
