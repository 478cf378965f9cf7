// SPDX-License-Identifier: MIT
#include "transport/caustics/caustic_lights.hpp"

#include "transport/caustics/through.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace abbe::transport::caustics {
namespace {

/// How often a band is halved where a root begins or ends in it, and where its light changes much.
constexpr std::size_t most_roots = 32;
constexpr int most_halvings = 10, smooth_halvings = 4;

void describe(Root const& root, CausticLight& light) {
  light.chain = root.chain;
  light.turned = root.turned;
  light.name = root.name;
  light.inside = root.inside;
}

double brightness(Root const& root) {
  return root.flux / root.spread;
}

} // namespace

CausticLights::CausticLights(Stage const& stage, Caustics const& caustics)
    : stage_(stage),
      caustics_(caustics),
      waves_(stage, caustics.waves()),
      connector_(stage, caustics, waves_) {}

std::vector<CausticLight> const& CausticLights::lights() {
  if (known_) return lights_;
  known_ = true;
  find();
  // The first light of each ray, then the second of each, and so on.
  std::array<std::uint32_t, chunk_width> count{};
  std::uint32_t lamp = 0;
  for (CausticLight& light : lights_) {
    if (light.lamp != lamp) count.fill(0);
    lamp = light.lamp;
    light.turn = count[light.ray]++;
  }
  std::stable_sort(lights_.begin(), lights_.end(), [](auto const& a, auto const& b) {
    return a.lamp != b.lamp ? a.lamp < b.lamp : a.turn < b.turn;
  });
  return lights_;
}

std::pair<double, double> CausticLights::spectrum_of(std::size_t ray) const {
  auto const& bands = caustics_.bands();
  std::pair<double, double> out{1, 0};
  if (bands.empty()) return out;
  std::uint16_t const* const lanes = chunk_->channels + ray * chunk_->each;
  for (std::size_t k = 0; k < chunk_->each; ++k) {
    double const a = caustics_.place_of(bands[lanes[k]].low_nm),
                 b = caustics_.place_of(bands[lanes[k]].high_nm);
    out = {std::min({out.first, a, b}), std::max({out.second, a, b})};
  }
  return out;
}

void CausticLights::find() {
  lights_.clear();
  values_.clear();
  find_tours();
  for (std::size_t lamp = 0; lamp < stage_.lamps.size(); ++lamp) {
    if (!caustics_.follows(lamp)) continue;
    lamp_ = lamp;
    blocked_ = 0;
    std::size_t const first = lights_.size();
    RaySet later = 0;
    for (Tour const& tour : tours_)
      for (std::size_t k = 0; k < tour.rays.size(); ++k)
        if (!tour.known(k)) later |= RaySet{1} << tour.rays[k];
    std::vector<std::uint8_t> rays;
    each_of(first_rays(chunk_->count) & ~later,
            [&](std::size_t r) { rays.push_back(static_cast<std::uint8_t>(r)); });
    find_on(rays);
    if (later == 0) continue;
    std::array<std::vector<std::uint32_t>, chunk_width> lights_of;
    for (std::size_t k = first; k < lights_.size(); ++k)
      lights_of[lights_[k].ray].push_back(static_cast<std::uint32_t>(k));
    rays.clear();
    for (Tour const& tour : tours_) {
      if (fill_in(tour, lights_of)) continue;
      for (std::size_t k = 0; k < tour.rays.size(); ++k)
        if (!tour.known(k)) rays.push_back(tour.rays[k]);
    }
    find_on(rays);
  }
}

void CausticLights::find_on(std::span<std::uint8_t const> rays) {
  Chunk const& chunk = *chunk_;
  SheetIndex const& index = caustics_.lamps()[lamp_].index;
  places_.clear();
  ray_of_.clear();
  wants_.clear();
  for (std::uint8_t const r : rays) {
    auto const [from, to] = spectrum_of(r);
    wants_.push_back({chunk.point.get(r), from, to});
  }
  index.find(wants_, over_);
  std::size_t count = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (over_[k].empty()) continue;
    std::swap(over_[count++], over_[k]);
    std::uint8_t const r = rays[k];
    LitPlace place;
    place.point = chunk.point.get(r);
    place.point_error = chunk.point_error.get(r);
    place.geometric = chunk.geometric.get(r);
    place.start = chunk.start_of(r, false);
    places_.push_back(place);
    ray_of_.push_back(r);
  }
  if (count == 0) return;
  find_whole();
  if (!caustics_.bands().empty()) find_bands();
}

Ask CausticLights::ask_of(std::uint32_t place, int wave, std::uint32_t first,
                          std::uint32_t last) const {
  double const weight =
      wave == Waves::whole ? 0 : std::clamp(caustics_.place_of(waves_.lambda_nm(wave)), 0.0, 1.0);
  return {place, wave, weight, first, last};
}

void CausticLights::find_whole() {
  std::size_t const lamp = lamp_;
  Chunk const& chunk = *chunk_;
  asks_.clear();
  asks_.each = chunk.each;
  asks_.in_order = chunk.kind.in_order();
  for (std::uint32_t place = 0; place < places_.size(); ++place) {
    auto const first = static_cast<std::uint32_t>(asks_.sheets.size());
    std::uint32_t const last = list_of(place, -1, false, false, false);
    if (first == last) continue;
    asks_.asks.push_back(ask_of(place, Waves::whole, first, last));
    std::uint16_t const* const channels = chunk.channels + ray_of_[place] * chunk.each;
    asks_.channels.insert(asks_.channels.end(), channels, channels + chunk.each);
  }
  if (asks_.asks.empty()) return;
  connector_.find(lamp, places_, *groups_, asks_, roots_, light_);
  surface::Channels const& colour = stage_.lamps[lamp]->value();
  for (std::size_t k = 0; k < roots_.size(); ++k) {
    Root const& root = roots_[k];
    double const value = brightness(root);
    std::uint32_t const place = asks_.asks[root.ask].place;
    if (!root.real) blocked_ |= RaySet{1} << ray_of_[place];
    if (!root.real || !std::isfinite(value)) continue;
    CausticLight light;
    light.lamp = static_cast<std::uint32_t>(lamp);
    light.ray = ray_of_[place];
    light.toward = -root.direction;
    light.distance = root.distance;
    light.values = static_cast<std::uint32_t>(values_.size());
    describe(root, light);
    for (std::size_t i = 0; i < chunk.each; ++i)
      values_.push_back(value * light_[k * chunk.each + i]
                        * colour[asks_.channels[root.ask * chunk.each + i]]);
    lights_.push_back(light);
  }
}

void CausticLights::add(Piece const& piece, double value, Root const& root) {
  if (!root.real || !(value > 0) || !std::isfinite(value)) return;
  CausticLight light;
  light.lamp = static_cast<std::uint32_t>(lamp_);
  light.ray = ray_of_[piece.place];
  light.channel = piece.channel;
  light.toward = -root.direction;
  light.distance = root.distance;
  describe(root, light);
  light.value = piece.share * value * stage_.lamps[lamp_]->value()[piece.channel];
  lights_.push_back(light);
}

bool CausticLights::settle(Piece const& piece) {
  // Nearest pairs of roots of one side of the map.
  struct Pair {
    std::size_t low, high;
    double apart;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < piece.low.size(); ++i)
    for (std::size_t k = 0; k < piece.high.size(); ++k)
      if (piece.low[i].turned == piece.high[k].turned)
        pairs.push_back({i, k, glm::distance(piece.low[i].name, piece.high[k].name)});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](Pair const& a, Pair const& b) { return a.apart < b.apart; });
  std::vector<std::uint8_t> low(piece.low.size(), 0), high(piece.high.size(), 0);
  std::vector<Pair> chosen;
  for (Pair const& pair : pairs)
    if (low[pair.low] == 0 && high[pair.high] == 0) {
      low[pair.low] = high[pair.high] = 1;
      chosen.push_back(pair);
    }
  // What comes at one end only begins or ends on the way: at a fold, or where something stands in
  // its way. Where nothing comes at both ends, it may still come between them, if the way from one
  // to the other is longer than the smallest opening.
  bool alone = false, uneven = false;
  double const least = 2 * told_to / piece.share;
  auto const matters = [&](Root const& root) { return root.real && !(brightness(root) <= least); };
  for (std::size_t i = 0; i < low.size(); ++i)
    alone = alone || (low[i] == 0 && matters(piece.low[i]));
  for (std::size_t i = 0; i < high.size(); ++i)
    alone = alone || (high[i] == 0 && matters(piece.high[i]));
  std::vector<Sheet> const& sheets = caustics_.lamps()[lamp_].index.sheets();
  for (Pair const& pair : chosen) {
    Root const &a = piece.low[pair.low], &b = piece.high[pair.high];
    alone =
        alone || (a.real != b.real && (matters(a) || matters(b)))
        || (!a.real && pair.apart > 0.5 * std::min(sheets[a.sheet].grain, sheets[b.sheet].grain));
    uneven =
        uneven || (matters(a) && b.real && (a.spread > 2 * b.spread || b.spread > 2 * a.spread));
  }
  // Where a whole ring of rays comes to one place there is no end of roots.
  bool const many = piece.low.size() + piece.high.size() > most_roots;
  if (alone && !many && piece.depth < most_halvings) return false;
  if (!many && uneven && piece.depth < smooth_halvings) return false;
  for (Pair const& pair : chosen) {
    Root const &a = piece.low[pair.low], &b = piece.high[pair.high];
    if (a.real != b.real) {
      Root const& one = a.real ? a : b;
      add(piece, 0.5 * brightness(one), one);
      continue;
    }
    Root mean = a;
    mean.direction = glm::normalize(a.direction + b.direction);
    mean.distance = 0.5 * (a.distance + b.distance);
    // J^2 is linear in the wavelength next to a fold: this is the mean of 1/J there.
    add(piece, 0.5 * (a.flux + b.flux) * 2 / (a.spread + b.spread), mean);
  }
  // What begins or ends in what is left of the band lasts for half of it.
  for (std::size_t i = 0; i < low.size(); ++i)
    if (low[i] == 0) add(piece, 0.5 * brightness(piece.low[i]), piece.low[i]);
  for (std::size_t i = 0; i < high.size(); ++i)
    if (high[i] == 0) add(piece, 0.5 * brightness(piece.high[i]), piece.high[i]);
  return true;
}

std::uint32_t CausticLights::list_of(std::uint32_t place, int chain, bool disperses,
                                     bool coloured_only, bool clear_only) {
  std::vector<Sheet> const& sheets = caustics_.lamps()[lamp_].index.sheets();
  for (SheetIndex::Over const& over : over_[place]) {
    int const own = sheets[over.sheet].chain;
    Chain const& of = caustics_.chains()[own];
    if (of.disperses != disperses || (chain >= 0 && own != chain) || (coloured_only && !of.coloured)
        || (clear_only && of.coloured))
      continue;
    asks_.sheets.push_back(over);
  }
  return static_cast<std::uint32_t>(asks_.sheets.size());
}

void CausticLights::ask_stop(std::uint32_t place, std::size_t stop, std::uint32_t first,
                             std::uint32_t last) {
  if (first == last) return;
  Stop const& at = stops_[place][stop];
  asks_.asks.push_back(ask_of(place, at.wave, first, last));
  asks_.channels.push_back(at.below);
  asks_.channels.push_back(at.above);
  stop_of_ask_.push_back(static_cast<std::uint32_t>(stop));
}

void CausticLights::take_roots() {
  connector_.find(lamp_, places_, *groups_, asks_, roots_, light_);
  for (std::size_t k = 0; k < roots_.size(); ++k) {
    Root const& root = roots_[k];
    std::uint32_t const place = asks_.asks[root.ask].place;
    if (!root.real) blocked_ |= RaySet{1} << ray_of_[place];
    auto& found = found_[{place, root.chain}];
    found.resize(stops_[place].size());
    Ends& ends = found[stop_of_ask_[root.ask]];
    ends.below.push_back(root);
    ends.below.back().flux *= light_[2 * k];
    ends.above.push_back(root);
    ends.above.back().flux *= light_[2 * k + 1];
  }
  asks_.clear();
  stop_of_ask_.clear();
}

/// By what a wavelength may be off that was turned into a place in the spectrum and back.
constexpr double at_stop = 1e-9;

void CausticLights::find_stops(std::uint32_t place, std::vector<std::uint16_t> const& wanted) {
  auto const& bands = caustics_.bands();
  std::vector<Stop>& stops = stops_[place];
  stops.clear();
  for (std::uint16_t const channel : wanted) {
    Caustics::Band const& band = bands[channel];
    if (stops.empty() || stops.back().wave != band.low)
      stops.push_back({band.low_nm, band.low, channel, channel, false});
    else
      stops.back().above = channel;
    if (band.high != band.low) stops.push_back({band.high_nm, band.high, channel, channel, false});
  }
  // A beam that passes the place within less than a band is looked for where it passes.
  std::vector<double> more;
  std::vector<Sheet> const& sheets = caustics_.lamps()[lamp_].index.sheets();
  struct Pass {
    double from = 1, to = 0;
    bool loose = false; ///< where some beam passes is known to a quarter of its width only
  };
  std::map<int, Pass> passes; // by chain
  for (SheetIndex::Over const& over : over_[place]) {
    Sheet const& sheet = sheets[over.sheet];
    if (!caustics_.chains()[sheet.chain].disperses) continue;
    Pass& pass = passes[sheet.chain];
    pass.from = std::min(pass.from, over.from);
    pass.to = std::max(pass.to, over.to);
    pass.loose = pass.loose || sheet.map < 0;
  }
  for (auto const& [chain, pass] : passes) {
    double const a = caustics_.lambda_at(pass.from), b = caustics_.lambda_at(pass.to);
    double const low = std::min(a, b), high = std::max(a, b);
    std::size_t inside = 0;
    for (Stop const& stop : stops)
      inside += low * (1 - at_stop) <= stop.nm && stop.nm <= high * (1 + at_stop) ? 1 : 0;
    bool const all_of_one = wanted.size() == 1 && inside == 2 && !pass.loose;
    if (inside > 2 || all_of_one) continue;
    for (double const share : {0.0, 0.25, 0.5, 0.75, 1.0})
      more.push_back(low + share * (high - low));
  }
  std::sort(more.begin(), more.end());
  std::vector<Stop> extra;
  double last = 0;
  for (double const nm : more) {
    if (nm - last < 1e-3) continue;
    auto const channel = std::ranges::find_if(
        wanted, [&](std::uint16_t c) { return bands[c].low_nm < nm && nm < bands[c].high_nm; });
    if (channel == wanted.end()) continue;
    last = nm;
    extra.push_back({nm, waves_.add(nm), *channel, *channel, false});
  }
  stops.insert(stops.end(), extra.begin(), extra.end());
  std::ranges::stable_sort(stops, {}, &Stop::nm);
  // Every so many of the bands' ends, where they are many and nothing else is asked for.
  bool const many =
      extra.empty() && wanted.size() >= 2 * coarse && stops.size() == wanted.size() + 1;
  for (std::size_t k = 0; k < stops.size(); ++k)
    stops[k].later = many && k % coarse != 0 && k + 1 != stops.size();
}

bool CausticLights::fill_in(std::uint32_t place, std::vector<Ends>& found) const {
  std::vector<Stop> const& stops = stops_[place];
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < stops.size(); ++k)
    if (!stops[k].later) known.push_back(k);
  std::size_t const tracks = found[known.front()].below.size();
  for (std::size_t const k : known)
    if (found[k].below.size() != tracks) return false;
  if (tracks == 0) return true;
  if (known.size() < 4) return false;
  std::vector<double> at;
  for (std::size_t const k : known) at.push_back(caustics_.place_of(stops[k].nm));
  std::vector<std::vector<Root>> made(tracks);
  std::vector<std::vector<std::size_t>> taken(known.size(), std::vector<std::size_t>());
  for (std::size_t t = 0; t < tracks; ++t) {
    // The same root from stop to stop: the nearest of its side.
    std::vector<Root const*> track{&found[known[0]].below[t]};
    for (std::size_t i = 1; i < known.size(); ++i) {
      auto const& here = found[known[i]].below;
      Root const* nearest = nullptr;
      for (std::size_t k = 0; k < here.size(); ++k) {
        if (here[k].turned != track.back()->turned || here[k].real != track.back()->real
            || std::ranges::find(taken[i], k) != taken[i].end())
          continue;
        if (nearest == nullptr
            || glm::distance(here[k].name, track.back()->name)
                   < glm::distance(nearest->name, track.back()->name))
          nearest = &here[k];
      }
      if (nearest == nullptr) return false;
      taken[i].push_back(static_cast<std::size_t>(nearest - here.data()));
      track.push_back(nearest);
    }
    if (!track.front()->real) {
      // Nothing comes: nor between, unless it passes an opening.
      std::vector<Sheet> const& sheets = caustics_.lamps()[lamp_].index.sheets();
      for (std::size_t i = 1; i < known.size(); ++i)
        if (glm::distance(track[i]->name, track[i - 1]->name)
            > 0.5 * std::min(sheets[track[i]->sheet].grain, sheets[track[i - 1]->sheet].grain))
          return false;
      continue;
    }
    auto const values = [&](auto const& get) {
      std::vector<double> out;
      for (Root const* root : track) out.push_back(get(*root));
      return out;
    };
    std::vector<double> const spread = values([](Root const&r) { return r.spread; }),
                              flux = values([](Root const&r) { return r.flux; });
    for (std::size_t i = 1; i < known.size(); ++i)
      if (spread[i] > 2 * spread[i - 1] || spread[i - 1] > 2 * spread[i]) return false;
    if (!is_even(at, spread) || !is_even(at, flux)) return false;
    for (std::size_t k = 0; k < stops.size(); ++k) {
      if (!stops[k].later) continue;
      double const here = caustics_.place_of(stops[k].nm);
      Root root = *track[k / coarse];
      root.spread = through(at, spread, here);
      root.flux = through(at, flux, here);
      Vec3 direction;
      for (int axis = 0; axis < 3; ++axis) {
        direction[axis] =
            through(at, values([&](Root const& r) { return r.direction[axis]; }), here);
        root.name[axis] = through(at, values([&](Root const& r) { return r.name[axis]; }), here);
      }
      root.direction = glm::normalize(direction);
      root.ask = static_cast<std::uint32_t>(k); // the stop, until it is put there
      made[t].push_back(root);
    }
  }
  for (auto const& track : made)
    for (Root const& root : track) {
      found[root.ask].below.push_back(root);
      found[root.ask].above.push_back(root);
    }
  return true;
}

void CausticLights::find_bands() {
  Chunk const& chunk = *chunk_;
  ChainTable const& chains = caustics_.chains();
  waves_.keep(caustics_.waves().count());
  asks_.clear();
  stop_of_ask_.clear();
  asks_.each = 2;
  asks_.in_order = false;
  found_.clear();
  stops_.resize(std::max(stops_.size(), places_.size()));
  std::vector<std::vector<std::uint16_t>> wanted(places_.size());
  for (std::uint32_t place = 0; place < places_.size(); ++place) {
    std::uint16_t const* const lanes = chunk.channels + ray_of_[place] * chunk.each;
    std::vector<std::uint16_t>& own = wanted[place];
    own.assign(lanes, lanes + chunk.each);
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    find_stops(place, own);
    auto const first = static_cast<std::uint32_t>(asks_.sheets.size());
    std::uint32_t const middle = list_of(place, -1, true, true, false);
    std::uint32_t const last = list_of(place, -1, true, false, true);
    for (std::size_t stop = 0; stop < stops_[place].size(); ++stop)
      ask_stop(place, stop, first, stops_[place][stop].later ? middle : last);
  }
  if (asks_.asks.empty()) return;
  take_roots();
  for (auto& [key, found] : found_) {
    auto const [place, chain] = key;
    if (chains[chain].coloured) continue;
    auto const& stops = stops_[place];
    if (std::ranges::none_of(stops, &Stop::later) || fill_in(place, found)) continue;
    auto const first = static_cast<std::uint32_t>(asks_.sheets.size());
    std::uint32_t const last = list_of(place, chain, true, false, true);
    for (std::size_t stop = 0; stop < stops.size(); ++stop)
      if (stops[stop].later) ask_stop(place, stop, first, last);
  }
  if (!asks_.asks.empty()) take_roots();
  settle_all();
}

void CausticLights::settle_all() {
  auto const& bands = caustics_.bands();
  std::vector<Piece> pieces;
  for (auto& [key, found] : found_) {
    Piece piece;
    piece.place = key.first;
    piece.chain = key.second;
    piece.depth = 0;
    auto const& stops = stops_[piece.place];
    for (std::size_t k = 0; k < stops.size(); ++k) {
      piece.channel = stops[k].above;
      Caustics::Band const& band = bands[piece.channel];
      if (band.low == band.high) {
        piece.share = 1;
        for (Root const& root : found[k].above) add(piece, brightness(root), root);
        continue;
      }
      if (k + 1 == stops.size() || stops[k + 1].below != piece.channel) continue;
      piece.low_nm = stops[k].nm;
      piece.high_nm = stops[k + 1].nm;
      piece.share = (piece.high_nm - piece.low_nm) / (band.high_nm - band.low_nm);
      piece.low = found[k].above;
      piece.high = found[k + 1].below;
      pieces.push_back(piece);
    }
  }
  while (true) {
    std::vector<Piece> parted;
    for (Piece& piece : pieces)
      if (!settle(piece)) parted.push_back(std::move(piece));
    if (parted.empty()) return;
    waves_.keep(caustics_.waves().count());
    std::map<double, int> middles;
    for (Piece const& piece : parted) {
      double const middle = 0.5 * (piece.low_nm + piece.high_nm);
      auto const [wave, fresh] = middles.emplace(middle, 0);
      if (fresh) wave->second = waves_.add(middle);
      auto const first = static_cast<std::uint32_t>(asks_.sheets.size());
      std::uint32_t const last = list_of(piece.place, piece.chain, true, false, false);
      asks_.asks.push_back(ask_of(piece.place, wave->second, first, last));
      asks_.channels.push_back(piece.channel);
      asks_.channels.push_back(piece.channel);
    }
    connector_.find(lamp_, places_, *groups_, asks_, roots_, light_);
    std::vector<std::vector<Root>> middle(parted.size());
    for (std::size_t k = 0; k < roots_.size(); ++k) {
      middle[roots_[k].ask].push_back(roots_[k]);
      middle[roots_[k].ask].back().flux *= light_[2 * k];
    }
    asks_.clear();
    pieces.clear();
    for (std::size_t i = 0; i < parted.size(); ++i) {
      Piece& piece = parted[i];
      Piece upper = piece;
      double const middle_nm = 0.5 * (piece.low_nm + piece.high_nm);
      piece.share = upper.share = 0.5 * piece.share;
      ++piece.depth;
      ++upper.depth;
      piece.high_nm = upper.low_nm = middle_nm;
      piece.high = middle[i];
      upper.low = std::move(middle[i]);
      pieces.push_back(std::move(piece));
      pieces.push_back(std::move(upper));
    }
  }
}

} // namespace abbe::transport::caustics
