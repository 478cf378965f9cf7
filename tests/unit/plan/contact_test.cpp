// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/plane.hpp"
#include "plan/plan.hpp"

#include <gtest/gtest.h>

namespace abbe::plan {
namespace {

scene::Object box(double from, double ior) {
  auto const placed = *geometry::make_box({from, 0, 0}, {from + 1, 1, 1});
  scene::Object out;
  out.shape = placed.shape;
  out.placement = placed.placement;
  auto interior = std::make_shared<scene::Interior>();
  interior->ior = ior;
  out.interior = interior;
  return out;
}
Finding contact_in(std::vector<scene::Object> objects,
                   double share = scene::Settings::default_contact) {
  scene::Scene scene;
  scene.objects.assign(objects.begin(), objects.end());
  scene.settings.contact = share;
  auto const plan = make_plan(scene);
  return plan ? plan->findings[static_cast<std::size_t>(Effect::ContactOfMedia)] : Finding{};
}

TEST(ContactOfMedia, IsCalledForByTwoRefractingSolidsThatMayTouch) {
  Finding const found = contact_in({box(0, 1.5), box(1, 1.33)});
  EXPECT_TRUE(found.on);
  EXPECT_EQ(found.reason, "ior 1.5 may touch ior 1.33");
  EXPECT_TRUE(contact_in({box(0, 1.5), box(1 + 1e-7, 1.33)}).on);
  EXPECT_TRUE(contact_in({box(0, 1.5), box(1.01, 1.33)}, .02).on);
  // Within unions, and beside a half-space.
  scene::Object both;
  both.kind = scene::Object::Kind::Union;
  both.children = std::vector{box(0, 1.5), box(1, 1.5)};
  EXPECT_TRUE(contact_in({both}).on);
  scene::Object water = box(0, 1.33);
  auto const placed = *geometry::make_plane({0, 1, 0}, -1);
  water.shape = placed.shape;
  water.placement = placed.placement;
  EXPECT_TRUE(contact_in({water, box(0, 1.5)}).on);
}

TEST(ContactOfMedia, IsOffWhereNothingCallsForIt) {
  EXPECT_FALSE(contact_in({}).on);
  EXPECT_FALSE(contact_in({box(0, 1.5)}).on);
  EXPECT_FALSE(contact_in({box(0, 1.5), box(1.01, 1.5)}).on);
  EXPECT_FALSE(contact_in({box(0, 1.5), box(1, 1)}).on);
  EXPECT_FALSE(contact_in({box(0, 1.5), box(1, 1.5)}, 0).on);
  scene::Object merged;
  merged.kind = scene::Object::Kind::Merge;
  merged.children = std::vector{box(0, 1.5), box(1, 1.5)};
  EXPECT_FALSE(contact_in({merged}).on);
}

} // namespace
} // namespace abbe::plan
