// SPDX-License-Identifier: MIT
#include "lang/evaluate.hpp"

#include "geometry/shape.hpp"
#include "optics/conductor.hpp"
#include "optics/glass.hpp"
#include "optics/spectrum.hpp"

#include <fmt/format.h>

#include <iterator>

namespace abbe::lang {

namespace {

using scene::Colour;
using scene::Object;
using scene::Pigment;

/// Nine digits, and no sign on zero.
std::string text(double value) {
  return fmt::format("{:.9g}", value == 0 ? 0.0 : value);
}
std::string text(Vec3 const& v) {
  return fmt::format("<{}, {}, {}>", text(v.x), text(v.y), text(v.z));
}
Vec3 rgb_of(optics::Spectrum const& spectrum) {
  if (spectrum.is_light_only()) return optics::light_rgb(spectrum);
  auto const rgb = optics::reflectance_rgb(spectrum);
  return rgb ? *rgb : Vec3(0);
}
std::string text(Colour const& c) {
  std::string out = fmt::format("rgb {}", text(c.rgb));
  if (c.filter != 0) out += fmt::format(" filter {}", text(c.filter));
  if (c.transmit != 0) out += fmt::format(" transmit {}", text(c.transmit));
  if (c.spectrum) out += fmt::format(" spectrum(rgb {})", text(rgb_of(*c.spectrum)));
  return out;
}
/// Linear part by rows, then the offset.
std::string text(Mat3 const& m, Vec3 const& offset) {
  return fmt::format("[{} {} {}] + {}", text(Vec3(m[0][0], m[1][0], m[2][0])),
                     text(Vec3(m[0][1], m[1][1], m[2][1])), text(Vec3(m[0][2], m[1][2], m[2][2])),
                     text(offset));
}

std::string_view name(Object::Kind kind) {
  switch (kind) {
  case Object::Kind::Shape:
    return "shape";
  case Object::Kind::Union:
    return "union";
  case Object::Kind::Merge:
    return "merge";
  case Object::Kind::Intersection:
    return "intersection";
  case Object::Kind::Difference:
    return "difference";
  case Object::Kind::LightGroup:
    return "light_group";
  }
  return "";
}

/// What follows the spacing, where it is not bands.
std::string text(scene::Representation const& representation) {
  using Kind = scene::Representation::Kind;
  switch (representation.kind) {
  case Kind::Bands:
    return "";
  case Kind::Composite:
    return " representation composite";
  case Kind::Basis:
    return fmt::format(" representation basis {}", representation.size);
  case Kind::Adaptive:
    return fmt::format(" representation adaptive tolerance {}", text(representation.tolerance));
  }
  return "";
}

class Dump {
public:
  std::string take() { return std::move(out_); }

  void scene(scene::Scene const& s) {
    settings(s.settings);
    camera(s.camera);
    line("background {}", text(s.background));
    if (s.sky_sphere) sky(*s.sky_sphere);
    for (scene::Light const& l : s.lights) light(l);
    for (scene::LightGroup const& g : s.light_groups)
      line("light_group in {}{}", g.outer, g.global_lights ? " global_lights" : "");
    for (scene::Fog const& f : s.fogs) fog(f);
    for (scene::Rainbow const& r : s.rainbows) rainbow(r);
    for (Object const& o : s.objects) object(o, "");
  }

private:
  void camera(scene::Camera const& c) {
    std::string kind(scene::camera_words[static_cast<std::size_t>(c.kind)]);
    if (c.kind == scene::Camera::Kind::Cylinder) kind += fmt::format(" {}", c.cylinder_type);
    std::string more;
    if (c.kind >= scene::Camera::Kind::Fisheye)
      more += fmt::format(" angle {} {}", text(c.angle_deg), text(c.vertical_angle_deg));
    if (c.aperture > 0)
      more += fmt::format(" aperture {} focal_distance {} blur_samples {}", text(c.aperture),
                          text(c.focal_distance), c.blur_samples);
    if (c.bokeh) more += " bokeh";
    line("camera {} location {} direction {} up {} right {}{}", kind, text(c.location),
         text(c.direction), text(c.up), text(c.right), more);
    Deeper const deeper(*this);
    if (c.normal) normal(*c.normal, "normal");
  }

  template <class... A>
  void line(fmt::format_string<A...> format, A&&... arguments) {
    out_.append(static_cast<std::size_t>(2 * depth_), ' ');
    fmt::format_to(std::back_inserter(out_), format, std::forward<A>(arguments)...);
    out_ += '\n';
  }
  /// Indents what is written while it lives.
  struct Deeper {
    explicit Deeper(Dump& of) : of_(of) { ++of_.depth_; }
    ~Deeper() { --of_.depth_; }
    Dump& of_;
  };

  void placement(geometry::Transform const& t) {
    if (!t.identity()) line("placement {}", text(t.linear, t.offset));
  }

  void settings(scene::Settings const& s) {
    line(
        "settings version {} adc_bailout {} max_trace_level {} ambient_light {} noise_generator {} "
        "assumed_gamma {}",
        text(s.version), s.adc_bailout ? text(*s.adc_bailout) : "unset",
        s.max_trace_level ? std::to_string(*s.max_trace_level) : "unset", text(s.ambient_light),
        s.noise_generator,
        s.assumed_gamma_srgb ? "srgb"
        : s.assumed_gamma    ? text(*s.assumed_gamma)
                             : "none");
    scene::SpectralSettings const& p = s.spectral;
    using Spacing = scene::SpectralSettings::Spacing;
    line("spectral {} bands {} range {} {} spacing {}{} dispersion {}{} unit {}",
         p.requested ? "requested" : "default", p.bands, text(p.low_nm), text(p.high_nm),
         p.spacing == Spacing::Uniform ? "uniform"
         : p.spacing == Spacing::Hall  ? "hall"
                                       : "boundaries",
         text(p.representation), text(p.dispersion),
         p.merge_px ? fmt::format(" merge {}", text(*p.merge_px)) : "", text(p.mm_per_unit));
    effects(s.effects);
    if (s.samples)
      line("samples {} to {} error {}", s.samples->least, s.samples->most, text(s.samples->error));
    scene::ThrownLight const& t = s.thrown;
    if (t.photons || t.caustics)
      line("thrown light{}{} error {} max_trace_level {} adc_bailout {}",
           t.caustics ? " caustics" : "", t.photons ? " photons" : "", text(t.error),
           t.max_trace_level, text(t.adc_bailout));
    if (p.spacing != Spacing::Boundaries) return;
    Deeper const deeper(*this);
    std::string edges;
    for (double const edge : p.boundaries_nm) edges += fmt::format(" {}", text(edge));
    line("boundaries{}", edges);
  }

  void effects(scene::EffectSettings const& e) {
    if (!e.strict && e.overrides.empty()) return;
    std::string words;
    for (auto const& each : e.overrides)
      words += fmt::format(" {} {}", scene::switch_words[static_cast<std::size_t>(each.effect)],
                           each.on ? "on" : "off");
    line("effects{}{}", e.strict ? " strict" : "", words);
  }

  void sky(scene::SkySphere const& s) {
    line("sky_sphere emission {}", text(s.emission));
    Deeper const deeper(*this);
    placement(s.placement);
    for (Pigment const& p : s.pigments) pigment(p, "pigment");
  }

  void light(scene::Light const& l) {
    using Kind = scene::Light::Kind;
    std::string rest;
    if (l.kind != Kind::Point) rest += fmt::format(" point_at {}", text(l.point_at));
    if (l.kind == Kind::Spot)
      rest += fmt::format(" radius {} falloff {} tightness {}", text(l.radius_deg),
                          text(l.falloff_deg), text(l.tightness));
    if (l.kind == Kind::Cylinder)
      rest += fmt::format(" radius {} falloff {} tightness {}", text(l.radius), text(l.falloff),
                          text(l.tightness));
    if (l.area) rest += area(*l.area);
    if (l.group != 0) rest += fmt::format(" group {}", l.group);
    if (l.media_attenuation) rest += " media_attenuation";
    if (!l.media_interaction) rest += " media_interaction off";
    if (l.shadowless) rest += " shadowless";
    rest += choice(l.throws.refraction, " photons refraction");
    rest += choice(l.throws.reflection, " photons reflection");
    if (l.fade_power != 0 || l.fade_distance != 0)
      rest +=
          fmt::format(" fade_distance {} fade_power {}", text(l.fade_distance), text(l.fade_power));
    line("light {} position {} {}{}",
         l.kind == Kind::Point      ? "point"
         : l.kind == Kind::Spot     ? "spot"
         : l.kind == Kind::Parallel ? "parallel"
                                    : "cylinder",
         text(l.position), text(l.colour), rest);
    Deeper const deeper(*this);
    if (l.projected_through) object(*l.projected_through, "projected_through ");
  }

  static std::string area(scene::AreaGrid const& a) {
    return fmt::format(" area {} {} {} {} adaptive {}{}{}{}{}", text(a.axis1), text(a.axis2),
                       a.size1, a.size2, a.adaptive, a.jitter ? " jitter" : "",
                       a.circular ? " circular" : "", a.orient ? " orient" : "",
                       a.illumination ? " area_illumination" : "");
  }

  void fog(scene::Fog const& f) {
    std::string rest;
    if (f.ground)
      rest +=
          fmt::format(" ground offset {} alt {} up {}", text(f.offset), text(f.alt), text(f.up));
    if (f.turbulence)
      rest +=
          fmt::format(" turbulence {} octaves {} omega {} lambda {} depth {}",
                      text(f.turbulence->amount), f.turbulence->octaves, text(f.turbulence->omega),
                      text(f.turbulence->lambda), text(f.turbulence_depth));
    line("fog {} distance {}{}", text(f.colour), text(f.distance), rest);
  }

  void rainbow(scene::Rainbow const& r) {
    std::string rest;
    if (r.jitter != 0) rest += fmt::format(" jitter {}", text(r.jitter));
    if (r.arc_deg) rest += fmt::format(" arc {}", text(*r.arc_deg));
    if (r.falloff_deg) rest += fmt::format(" falloff {}", text(*r.falloff_deg));
    line("rainbow direction {} up {} angle {} width {} distance {}{}", text(r.direction),
         text(r.up), text(r.angle_deg), text(r.width_deg), text(r.distance), rest);
    Deeper const deeper(*this);
    for (auto const& entry : r.entries) line("{} {}", text(entry.value), text(entry.colour));
  }

  static std::string choice(scene::Choice made, std::string_view word) {
    if (made == scene::Choice::Unset) return "";
    return fmt::format("{} {}", word, made == scene::Choice::On ? "on" : "off");
  }

  static std::string throws(scene::Throws const& t) {
    std::string out;
    if (t.target) out += " target";
    out += choice(t.refraction, " refraction");
    out += choice(t.reflection, " reflection");
    out += choice(t.cast, " cast");
    if (!t.collect) out += " collect off";
    if (t.pass_through) out += " pass_through";
    return out.empty() ? out : " photons" + out;
  }

  void object(Object const& o, std::string_view role) {
    std::string flags;
    auto const flag = [&](std::optional<bool> on, std::string_view word) {
      if (on.value_or(false)) flags += fmt::format(" {}", word);
    };
    flag(o.inverse, "inverse");
    flag(o.hollow, "hollow");
    flag(o.no_shadow, "no_shadow");
    flag(o.no_image, "no_image");
    flag(o.no_reflection, "no_reflection");
    flag(o.double_illuminate, "double_illuminate");
    flags += throws(o.throws);
    bool const shape = o.kind == Object::Kind::Shape;
    if (o.light_group != 0) flags += fmt::format(" light_group {}", o.light_group);
    line("{}{}{}", role, shape ? o.keyword : name(o.kind), flags);
    Deeper const deeper(*this);
    if (shape) surface(o);
    for (Object const& clip : o.clipped_by) object(clip, "clipped_by ");
    for (Object const& child : o.children) object(child, "");
    if (!o.instance) return;
    auto const [known, fresh] = instances_.try_emplace(o.instance.get(), instances_.size() + 1);
    line("instance {}", known->second);
    placement(o.placement);
    if (fresh)
      for (Object const& child : std::as_const(*o.instance).children) object(child, "");
  }

  void surface(Object const& o) {
    if (o.shape) {
      geometry::Bounds const b = o.shape->bounds();
      if (b.infinite)
        line("bounds infinite");
      else
        line("bounds {} {}", text(b.low), text(b.high));
    }
    placement(o.placement);
    if (o.texture)
      for (scene::Texture const& t : *o.texture) texture(t, "texture");
    if (o.interior_texture)
      for (scene::Texture const& t : *o.interior_texture) texture(t, "interior_texture");
    for (scene::Layers const& layers : o.face_textures)
      for (scene::Texture const& t : layers) texture(t, "face_texture");
    if (o.interior) interior(*o.interior);
  }

  void texture(scene::Texture const& t, std::string_view role) {
    line("{}", role);
    Deeper const deeper(*this);
    placement(t.placement);
    if (t.uv) line("uv_mapping");
    if (t.map) return map(*t.map);
    pigment(t.pigment, "pigment");
    if (t.normal) normal(*t.normal, "normal");
    finish(*t.finish);
  }

  void map(scene::TextureMap const& m) {
    pattern(*m.pattern, "texture_map");
    Deeper const deeper(*this);
    for (auto const& entry : m.entries)
      for (scene::Texture const& t : entry.layers)
        texture(t, fmt::format("[{}]", text(entry.value)));
  }

  void normal(scene::Normal const& n, std::string const& role) {
    if (!n.pattern) return line("{} none", role);
    pattern(*n.pattern, role);
    Deeper const deeper(*this);
    line("bump_size {} accuracy {}{}", text(n.amount), text(n.accuracy),
         n.no_bump_scale ? " no_bump_scale" : "");
    for (auto const& slope : n.slopes)
      line("[{}] height {} slope {}", text(slope.value), text(slope.height), text(slope.slope));
    for (auto const& entry : n.entries)
      normal(*entry.normal, fmt::format("[{}]", text(entry.value)));
  }

  void pigment(Pigment const& p, std::string const& role) {
    if (!p.pattern) return line("{} {}", role, text(p.colour));
    pattern(*p.pattern, role);
    Deeper const deeper(*this);
    for (Pigment::Entry const& entry : p.entries)
      pigment(*entry.pigment, fmt::format("[{}]", text(entry.value)));
  }

  void pattern(texture::PatternInstance const& p, std::string_view role) {
    texture::PatternModifiers const& m = p.modifiers;
    std::string rest;
    if (m.turbulence)
      rest +=
          fmt::format(" turbulence {} octaves {} omega {} lambda {}", text(m.turbulence->amount),
                      m.turbulence->octaves, text(m.turbulence->omega), text(m.turbulence->lambda));
    if (m.frequency) rest += fmt::format(" frequency {}", text(*m.frequency));
    if (m.phase != 0) rest += fmt::format(" phase {}", text(m.phase));
    if (m.wave) rest += fmt::format(" wave {}", static_cast<int>(*m.wave));
    // A pattern has no name here: its values at two places tell which it is.
    line("{} pattern value {} {} noise_generator {}{}", role, text(p.evaluate(Vec3(0.3, 0.7, 1.9))),
         text(p.evaluate(Vec3(-1.1, 2.3, 0.4))), m.noise_generator, rest);
    Deeper const deeper(*this);
    if (p.uv) line("uv_mapping");
    for (texture::Mapping const& mapping : p.mappings)
      if (mapping.warp)
        line("warp {} {}", text(mapping.warp->apply(Vec3(0.3, 0.7, 1.9))),
             text(mapping.warp->apply(Vec3(-1.1, 2.3, 0.4))));
      else
        line("mapping {}", text(mapping.linear, mapping.offset));
  }

  void finish(scene::Finish const& f) {
    line("finish ambient {} emission {} diffuse {} {} brilliance {} phong {} {} specular {} {} "
         "metallic {}{}",
         text(f.ambient), text(f.emission), text(f.diffuse), text(f.diffuse_back),
         text(f.brilliance), text(f.phong), text(f.phong_size), text(f.specular), text(f.roughness),
         text(f.metallic), f.conserve_energy ? " conserve_energy" : "");
    if (!f.reflection) return;
    Deeper const deeper(*this);
    scene::Reflection const& r = *f.reflection;
    line("reflection {} to {}{} falloff {} exponent {} metallic {}{}", text(r.minimum),
         text(r.maximum), r.fresnel ? " fresnel" : "", text(r.falloff), text(r.exponent),
         text(r.metallic), r.metal ? fmt::format(" metal {}", r.metal->name()) : "");
  }

  void interior(scene::Interior const& i) {
    std::string const glass = i.glass
                                  ? fmt::format("glass \"{}\" nd {} Vd {}{}", i.glass->full_name(),
                                                i.glass->nd() ? text(*i.glass->nd()) : "-",
                                                i.glass->vd() ? text(*i.glass->vd()) : "-",
                                                i.glass->absorbs() ? " absorbs" : "")
                                  : fmt::format("ior {} dispersion {} samples {}", text(i.ior),
                                                text(i.pov_dispersion), i.pov_dispersion_samples);
    line("interior {} mode {} caustics {} fade_distance {} fade_power {} fade_color {}{}", glass,
         text(i.dispersion), text(i.caustics), text(i.fade_distance), text(i.fade_power),
         text(i.fade_colour), i.priority != 0 ? fmt::format(" priority {}", i.priority) : "");
  }

  std::string out_;
  int depth_ = 0;
  std::map<Object const*, std::size_t> instances_; ///< numbers of those that were shown
};

} // namespace

std::string dump_scene(scene::Scene const& scene) {
  Dump dump;
  dump.scene(scene);
  return dump.take();
}

} // namespace abbe::lang
