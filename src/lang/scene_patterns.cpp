// SPDX-License-Identifier: MIT
#include "lang/scene_patterns.hpp"

#include "lang/block_function.hpp"
#include "lang/blocks.hpp"
#include "lang/function.hpp"
#include "lang/image_pattern.hpp"
#include "lang/object_query.hpp"

#include <cmath>

namespace abbe::lang {

namespace {

using texture::Pattern, texture::PatternModifiers;

class FunctionPattern final : public Pattern {
public:
  explicit FunctionPattern(std::shared_ptr<FunctionValue const> function)
      : function_(std::move(function)) {}
  double raw(Vec3 const& p, PatternModifiers const&) const override {
    double const arguments[] = {p.x, p.y, p.z};
    double const value = evaluate_function(*function_, arguments).scalar();
    return value > 1 ? std::fmod(value, 1.0) : value;
  }

private:
  std::shared_ptr<FunctionValue const> function_;
};

class ObjectPattern final : public Pattern {
public:
  explicit ObjectPattern(scene::Object const& object) : query_(ObjectQuery::of(object)) {}
  double raw(Vec3 const& p, PatternModifiers const&) const override {
    return !query_.nothing() && query_.inside(p) ? 1 : 0;
  }
  int list_size() const override { return 2; }
  double default_frequency() const override { return 0; }
  std::span<DefaultEntry const> default_map() const override {
    static DefaultEntry const blue_green[] = {{0, Vec3(0, 0, 1)}, {1, Vec3(0, 1, 0)}};
    return blue_green;
  }

private:
  ObjectQuery query_;
};

class PigmentPattern final : public Pattern {
public:
  explicit PigmentPattern(scene::Pigment pigment) : pigment_(std::move(pigment)) {}
  double raw(Vec3 const& p, PatternModifiers const&) const override {
    constexpr int grey = -1;
    return take_part(lang::colour_at(pigment_, p), grey);
  }

private:
  scene::Pigment pigment_;
};

} // namespace

bool starts_function(Reader& in) {
  Value const* const value = in.identifier();
  return value && std::holds_alternative<std::shared_ptr<FunctionValue>>(value->any);
}

std::shared_ptr<Pattern const> read_function_pattern(Reader& in, bool&) {
  Span const at = in.next_span();
  std::shared_ptr<FunctionValue const> const function =
      std::get<std::shared_ptr<FunctionValue>>(in.identifier()->any);
  in.take();
  if (!function->unsupported.empty())
    in.report(Severity::Error, "E0901", function->unsupported, at);
  else if (function->picture_width != 0)
    in.report(Severity::Error, "E0622", "a function with a size is a picture, not a pattern", at);
  else if (function->parameters != 3)
    in.report(Severity::Error, "E0622",
              "a function of x, y and z is wanted, not one of "
                  + std::to_string(function->parameters) + " arguments",
              at);
  else
    return std::make_shared<FunctionPattern>(function);
  return nullptr;
}

std::shared_ptr<Pattern const> read_object_pattern(Reader& in, bool& encloses) {
  Span const at = in.next_span();
  in.open("object");
  encloses = true;
  auto const object = accept_object(in);
  if (object) return std::make_shared<ObjectPattern>(*object);
  in.report(Severity::Error, "E0250", "expected the object whose inside this pattern is", at);
  return nullptr;
}

std::shared_ptr<Pattern const> read_pigment_pattern(Reader& in, bool&) {
  in.open("pigment_pattern");
  scene::Pigment pigment = default_texture(in, in.block_span()).pigment;
  read_pigment(in, pigment);
  in.close();
  return make_pigment_pattern(std::move(pigment));
}

std::shared_ptr<Pattern const> make_pigment_pattern(scene::Pigment pigment) {
  return std::make_shared<PigmentPattern>(std::move(pigment));
}

std::span<ScenePatternKind const> scene_pattern_kinds() {
  static constexpr ScenePatternKind kinds[] = {
      {"bump_map", read_bump_map},     {"density_file", read_density_file, false},
      {"image_map", read_image_map},   {"image_pattern", read_image_pattern},
      {"object", read_object_pattern}, {"pigment_pattern", read_pigment_pattern},
  };
  return kinds;
}

} // namespace abbe::lang
