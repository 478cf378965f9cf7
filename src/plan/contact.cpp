// SPDX-License-Identifier: MIT
#include "plan/contact.hpp"

#include "geometry/bounds.hpp"
#include "geometry/contact.hpp"
#include "geometry/placed.hpp"
#include "plan/dispersion.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace abbe::plan {
namespace {

using geometry::all_space;
using geometry::Bounds;
using scene::Interior;
using scene::Object;

Bounds bounds_of(Object const& object);

/// Without what it is clipped by; of an intersection the overlap of its parts' boxes.
Bounds whole_bounds_of(Object const& object) {
  if (object.inverse) return all_space();
  if (object.kind == Object::Kind::Shape)
    return geometry::Placed(object.shape, object.placement).bounds();
  Bounds out;
  bool first = true;
  for (Object const& child : object.children) {
    if (object.kind == Object::Kind::Difference && !first) break;
    Bounds const part = bounds_of(child);
    if (first)
      out = part;
    else
      out = object.kind == Object::Kind::Intersection ? overlap(out, part) : hull(out, part);
    first = false;
  }
  return out;
}

Bounds bounds_of(Object const& object) {
  Bounds out = whole_bounds_of(object);
  for (Object const& clip : object.clipped_by) out = overlap(out, bounds_of(clip));
  return out;
}

/// The interior that a combination gets: its own, else the first of its parts'.
Interior const* interior_of(Object const& object) {
  if (object.interior) return object.interior.get();
  for (Object const& child : object.children)
    if (Interior const* found = interior_of(child)) return found;
  return nullptr;
}

class Media {
public:
  std::vector<Bounds> boxes;
  std::vector<Interior const*> interiors;

  void add(Object const& object) {
    if (object.kind == Object::Kind::Union && !object.inverse) {
      for (Object const& child : object.children) add(child);
      return;
    }
    Interior const* const interior = interior_of(object);
    if (!interior || (!dispersive_glass(*interior) && plain_index(*interior) == 1)) return;
    boxes.push_back(bounds_of(object));
    interiors.push_back(interior);
  }
};

std::string name_of(Interior const& interior) {
  auto const glass = dispersive_glass(interior);
  return glass ? glass->full_name() : fmt::format("ior {:g}", plain_index(interior));
}

} // namespace

std::optional<MediaContact> find_contact(scene::Scene const& scene) {
  if (scene.settings.contact == 0) return std::nullopt;
  Media media;
  for (Object const& object : scene.objects) media.add(object);
  if (media.boxes.size() < 2) return std::nullopt;
  geometry::Contacts const contacts(media.boxes, scene.settings.contact);
  for (std::uint32_t i = 0; i < media.boxes.size(); ++i) {
    auto const partners = contacts.partners(i);
    if (partners.empty()) continue;
    Interior const& one = *media.interiors[i];
    Interior const& other = *media.interiors[partners.front().item];
    return MediaContact{name_of(one) + " may touch " + name_of(other), other.span};
  }
  return std::nullopt;
}

} // namespace abbe::plan
