// SPDX-License-Identifier: MIT
#include "job/job.hpp"
#include "lang/evaluate.hpp"
#include "lang/folders.hpp"
#include <abbe.hpp>

#include <algorithm>

namespace abbe {
namespace {

/// Puts the rows of a picture one after another.
class Memory : public job::Sink {
public:
  explicit Memory(Picture& picture) : picture_(picture) {}
  image::Status take(image::Image const& rows, int) override {
    picture_.rgb.insert(picture_.rgb.end(), rows.rgb.begin(), rows.rgb.end());
    return std::monostate();
  }
  image::Status finish(render::RenderResult const&) override { return std::monostate(); }

private:
  Picture& picture_;
};

Message to_message(Diagnostic const& diagnostic) {
  Message out;
  out.kind = diagnostic.severity == Severity::Error ? Message::Kind::Error : Message::Kind::Warning;
  out.code = diagnostic.code;
  out.text = diagnostic.message;
  if (!diagnostic.span.valid()) return out;
  auto const place = diagnostic.span.source->place(diagnostic.span.begin);
  out.file = diagnostic.span.source->name();
  out.line = static_cast<int>(place.line);
  out.column = static_cast<int>(place.column);
  return out;
}

Picture failed(Picture picture, Error const& error) {
  picture.end = Picture::End::SceneIsWrong;
  picture.rgb.clear();
  picture.messages.push_back({Message::Kind::Error, error.code, error.message, {}, 0, 0});
  return picture;
}

/// What is wrong with the options; empty: nothing.
std::string check(PictureOptions const& options) {
  constexpr int most = 100000;
  if (options.width < 1 || options.height < 1 || options.width > most || options.height > most)
    return "a picture has 1 to 100000 pixels across and down";
  if (options.threads < 0 || options.threads > 1024) return "threads must lie in 0..1024";
  if (options.aa_depth < 0 || options.aa_depth > 64) return "aa_depth must lie in 0..64";
  if (!(options.aa_threshold >= 0 && options.aa_threshold <= 3))
    return "aa_threshold must lie in 0..3";
  if (!(options.aa_jitter >= 0 && options.aa_jitter <= 1)) return "aa_jitter must lie in 0..1";
  if (options.bands < 0 || options.bands > 1000) return "bands must lie in 0..1000";
  return {};
}

lang::EvaluateOptions reading(PictureOptions const& options, Picture& picture) {
  lang::EvaluateOptions out;
  out.stdlib_dir = options.stdlib.empty() ? lang::stdlib_dir() : options.stdlib;
  out.povray_dir = lang::povray_dir();
  out.include_dirs = options.include_folders;
  out.read_dirs = options.read_folders;
  out.declarations = options.declarations;
  out.image_width = options.width;
  out.image_height = options.height;
  out.stop = options.stop;
  out.on_message = [&](std::string_view text) {
    picture.messages.push_back({Message::Kind::Text, {}, std::string(text), {}, 0, 0});
  };
  return out;
}

Picture make(lang::Evaluated evaluated, PictureOptions const& options, Picture picture) {
  for (auto const& diagnostic : evaluated.diagnostics)
    picture.messages.push_back(to_message(diagnostic));
  picture.end = evaluated.interrupted  ? Picture::End::Interrupted
                : evaluated.unreadable ? Picture::End::Unreadable
                                       : Picture::End::SceneIsWrong;
  if (evaluated.interrupted || !evaluated.ok()) return picture;
  plan::Overrides overrides;
  if (options.bands > 0) overrides.bands = options.bands;
  auto const plan = plan::make_plan(evaluated.scene, overrides);
  if (!plan) return failed(std::move(picture), plan.error());
  job::Options job;
  job.render.width = options.width;
  job.render.height = options.height;
  job.render.threads = options.threads;
  if (options.aa_depth > 0)
    job.render.anti_aliasing = {1, options.aa_depth, options.aa_threshold, options.aa_jitter, true,
                                {}};
  else if (options.samples == 0 && evaluated.scene.settings.samples)
    job.render.anti_aliasing = render::AntiAliasing::of(*evaluated.scene.settings.samples);
  if (options.samples > 0)
    job.render.anti_aliasing = render::AntiAliasing::of(
        {options.samples, std::max(options.samples, options.most_samples), options.samples_error});
  job.render.seed = options.seed;
  job.render.stop = options.stop;
  if (options.on_progress)
    job.render.on_progress = [&](render::Progress const& now) { options.on_progress(now.share); };
  Memory memory(picture);
  auto const outcome = job::run(std::move(evaluated.scene), *plan, job, memory);
  switch (outcome.end) {
  case job::Outcome::End::Done:
    picture.end = Picture::End::Done;
    picture.width = options.width;
    picture.height = options.height;
    return picture;
  case job::Outcome::End::Interrupted:
    picture.end = Picture::End::Interrupted;
    picture.rgb.clear();
    return picture;
  case job::Outcome::End::BadSample:
    return failed(std::move(picture),
                  {"E0710", "the light of a pixel is not a number, infinite or negative"});
  case job::Outcome::End::NotResumed:
  case job::Outcome::End::NotTaken:
    break;
  }
  return failed(std::move(picture), *outcome.error);
}

/// @param read evaluates the scene
template <class Read>
Picture run(PictureOptions const& options, Read const& read) {
  Picture picture;
  if (auto const wrong = check(options); !wrong.empty())
    return failed(std::move(picture), {"E0512", wrong});
  auto evaluated = read(reading(options, picture));
  return make(std::move(evaluated), options, std::move(picture));
}

} // namespace

Picture render_text(std::string const& text, PictureOptions const& options,
                    std::string const& name) {
  return run(options, [&](lang::EvaluateOptions const& reading) {
    return lang::evaluate_text(name, text, reading);
  });
}

Picture render_file(std::filesystem::path const& path, PictureOptions const& options) {
  return run(options, [&](lang::EvaluateOptions const& reading) {
    return lang::evaluate_file(path, reading);
  });
}

char const* version() {
  return ABBE_VERSION;
}

} // namespace abbe
