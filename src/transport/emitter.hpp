// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "transport/chunk.hpp"
#include "transport/cut_light.hpp"
#include "transport/paths.hpp"
#include "transport/ray_counts.hpp"
#include "transport/sample_film.hpp"

namespace abbe::transport {

/// What the rays of a queue have in common. Rays that come back from a surface and rays that go on
/// stand apart: so the order of a sample's rays does not depend on which others are worked on with
/// them.
struct QueueKey {
  LightKind kind;
  std::uint8_t mask = camera_bit;
  std::uint32_t mirrored = 0; ///< 0: goes on; else the mirror that it comes back from (OwnMirror)
  auto operator<=>(QueueKey const&) const = default;
};

/// Rays that leave what a chunk met, in any number; arrays have a value for each of them, or for
/// each of their lanes.
struct Departing {
  LightKind kind;
  std::uint32_t mirrored = 0;                  ///< as in QueueKey
  std::uint64_t RayCounts::*counted = nullptr; ///< null: the same ray goes on
  std::size_t count = 0;
  std::uint32_t* ray = nullptr;                    ///< of the chunk, that it comes of
  double *x = nullptr, *y = nullptr, *z = nullptr; ///< directions
  std::uint16_t* level = nullptr;
  std::uint32_t* slot = nullptr;
  std::uint16_t *channel = nullptr, *tooth = nullptr;
  std::uint16_t* channels = nullptr; ///< a lane; where the kind lists them
  double* light = nullptr;           ///< a lane
  std::uint32_t* path = nullptr;     ///< null: the chunk's
};

/// Rays of a chunk that leave its surface as they came: with the lanes that they have.
struct Onward {
  ChunkLight const& like;      ///< kind and channels; slots, unless others are given
  std::uint32_t const* slot;   ///< a ray
  double const* light;         ///< a lane
  Vectors const& way;          ///< directions
  RaySet rays = 0, deeper = 0; ///< which; which are a level deeper
  std::uint32_t mirrored = 0;  ///< as in QueueKey
  std::uint64_t RayCounts::*counted = nullptr;
};

/// Puts rays into the queues of the next generation, or notes what is cut of their light.
class Emitter {
public:
  Emitter(Stage const& stage, Arena& arena, WaveTables& waves, SampleFilm& film, Paths& paths);

  void start_samples(std::size_t count);
  /// Room for so many; they are in the arena.
  Departing room(LightKind const& kind, std::size_t count) const;
  void send(Chunk const& chunk, Departing const& rays);
  void send(Chunk const& chunk, Onward const& rays);
  /// Light of a ray that is not followed.
  void cut(std::uint32_t slot, double const* light, std::size_t lanes);
  /// The light is lost, or may be. @return false: nothing that can be seen
  bool lose(std::uint32_t slot, double const* light, std::size_t lanes);

  Queues<QueueKey>& next() { return *next_; }
  Rays::Fields const& fields() const { return fields_; }
  Rays& queue(QueueKey const& key) { return next_->of(key, key.kind, fields_); }
  /// What is next becomes what is now.
  Queues<QueueKey>& turn();

  /// Of a sample: of red, green or blue, whichever lost most.
  double lost_of(std::size_t sample) const;
  /// Of what is gathered apart, by slot.
  double lost_at(std::uint32_t slot) const;

  RayCounts counts;
  CutLight cut_light;
  /// By sample, where asked for (count_rays(), Stage::most_rays).
  std::vector<std::uint32_t> rays_of_sample;
  void count_rays() { counts_samples_ = true; }
  /// Throughput below which a ray of a sample is not followed. It depends on the rays that the
  /// sample has taken up to the generation before.
  double threshold(std::size_t sample) const {
    return stage_.most_rays == 0 ? stage_.adc_bailout : thresholds_[sample];
  }
  void count_ray(std::size_t sample) {
    if (counts_samples_) ++rays_of_sample[sample];
  }

private:
  /// Where rays start from that leave what a chunk met; of ray number i of those: ray_of(i).
  template <class RayOf>
  void set_starts(Chunk const& chunk, Rays& to, std::size_t first, std::size_t count, bool through,
                  RayOf const& ray_of) const;

  Stage const& stage_;
  Arena& arena_;
  WaveTables& waves_;
  SampleFilm& film_;
  Rays::Fields fields_;
  Queues<QueueKey> queues_[2];
  Queues<QueueKey>*now_ = queues_, *next_ = queues_ + 1;
  std::vector<std::array<LightSum, 3>> lost_; ///< by sample
  bool loses_ = false;                        ///< any of them
  std::vector<LightSum> lost_apart_;          ///< by slot, from that of the first block apart on
  std::vector<double> thresholds_;            ///< by sample
  bool counts_samples_ = false;
};

} // namespace abbe::transport
