// SPDX-License-Identifier: MIT
// Camera and shadow rays against many triangles and many spheres: nanoseconds a ray that World
// takes in batches, and Embree's single robust rays over the same triangles where its library is
// installed. `ninja bench_hierarchy`; arguments: names of scenes, else all of them.
#include "geometry/batch.hpp"
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#if ABBE_HAS_EMBREE
#include <embree3/rtcore.h>
#include <pmmintrin.h>
#endif

namespace abbe::geometry {
namespace {

constexpr std::size_t width = 640, height = 480, pixels = width * height, batch = 1024;
constexpr int runs = 11;

/// Vectors of all pixels.
struct Vectors {
  std::vector<double> numbers = std::vector<double>(3 * pixels);
  VectorArrays arrays() {
    return {numbers.data(), numbers.data() + pixels, numbers.data() + 2 * pixels};
  }
};
struct Rays {
  Vectors origin, direction, error;
  std::vector<RayStart> start = std::vector<RayStart>(pixels);
  std::vector<double> until = std::vector<double>(pixels);
  std::size_t count = 0;
  RayLines lines(std::size_t first) {
    return {std::min(batch, count - first), origin.arrays().from(first),
            direction.arrays().from(first), error.arrays().from(first),
            start.data() + first,           nullptr};
  }
};

struct Scene {
  std::string name;
  Vec3 eye, ahead;
  double view; ///< degrees across
  std::vector<PlacedShape> shapes;
  MeshData mesh;                    ///< the one shape, for Embree
  std::vector<World::Solid> solids; ///< none: each shape is one
};

Scene waves(int side, bool smooth) {
  Scene scene{"waves", {5, 8, -6}, {0, -8, 10}, 60, {}, {}, {}};
  double const step = 10.0 / side;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      scene.mesh.vertices.push_back(
          {i * step, std::sin(i * step * 5) * std::cos(j * step * 3), j * step});
  auto const at = [&](int i, int j) { return static_cast<std::uint32_t>(i * side + j); };
  for (int i = 0; i + 1 < side; ++i)
    for (int j = 0; j + 1 < side; ++j) {
      scene.mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      scene.mesh.faces.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  if (smooth) {
    scene.mesh.normals.assign(scene.mesh.vertices.size(), Vec3(0, 1, 0));
    scene.name = "smooth";
  }
  scene.shapes.push_back(*make_mesh(scene.mesh).shape);
  return scene;
}
Scene spheres(int count) {
  Scene scene{"spheres" + std::to_string(count), {0, 0, -18}, {0, 0, 1}, 40, {}, {}, {}};
  std::mt19937_64 numbers(1);
  std::uniform_real_distribution<double> place(-5, 5), size(0.5, 1.5);
  double const radius = 2.2 / std::cbrt(count);
  for (int i = 0; i < count; ++i) {
    double const x = place(numbers), y = place(numbers), z = place(numbers);
    scene.shapes.push_back(*make_sphere({x, y, z}, radius * size(numbers)));
  }
  return scene;
}

/// A ball and a bitten box on a floor.
Scene glassy() {
  Scene scene{"glassy", {3, 4, -8}, {-3, -3.2, 8}, 36, {}, {}, {}};
  Transform const turned = Transform::rotation({0, 15, 0});
  scene.shapes = {*make_plane({0, 1, 0}, 0), *make_sphere({-1.2, 1.05, 0.4}, 1),
                  *make_box({0.2, 0.1, -0.9}, {2, 1.8, 0.9}), *make_sphere({1.1, 1.8, 0}, 0.65)};
  for (std::size_t i = 2; i < 4; ++i)
    scene.shapes[i].placement = scene.shapes[i].placement.then(turned);
  auto const leaf = [](PrimitiveId id) {
    CsgTree tree;
    tree.primitive = id;
    return tree;
  };
  CsgTree bitten;
  bitten.op = CsgTree::Op::Difference;
  bitten.children = {leaf(2), leaf(3)};
  scene.solids = {{leaf(0)}, {leaf(1)}, {bitten}};
  return scene;
}

void look(Scene const& scene, Rays& rays) {
  Vec3 const ahead = glm::normalize(scene.ahead);
  Vec3 const right = glm::normalize(glm::cross(Vec3(0, 1, 0), ahead)),
             up = glm::cross(ahead, right);
  double const ratio = double(width) / height;
  double const far = 0.5 * ratio / std::tan(scene.view / 2 * M_PI / 180);
  rays.count = pixels;
  for (std::size_t k = 0; k < pixels; ++k) {
    double const x = (static_cast<double>(k % width) + 0.5) / width - 0.5;
    double const y = 0.5 - (static_cast<double>(k / width) + 0.5) / height;
    rays.origin.arrays().set(k, scene.eye);
    rays.direction.arrays().set(k, glm::normalize(far * ahead + ratio * x * right + y * up));
    rays.error.arrays().set(k, Vec3(0));
    rays.until[k] = 1e30;
  }
}

using Clock = std::chrono::steady_clock;
/// work(first ray of a batch) for all batches, in ns a ray: the sum of the least time of each in
/// several runs, which other processes show in least.
template <class Work>
double time_of(std::size_t count, Work const& work) {
  std::vector<double> least((count + batch - 1) / batch, 1e300);
  for (int run = 0; run < runs; ++run) {
    for (std::size_t k = 0; k < least.size(); ++k) {
      auto const start = Clock::now();
      work(k * batch);
      least[k] = std::min(least[k],
                          std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    }
  }
  return std::accumulate(least.begin(), least.end(), 0.0) / static_cast<double>(count);
}

#if ABBE_HAS_EMBREE
struct Embree {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  explicit Embree(MeshData const& mesh) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertex = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      for (int c = 0; c < 3; ++c)
        vertex[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(mesh.vertices[i][c]);
    void* const index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                RTC_FORMAT_UINT3, 12, mesh.faces.size());
    std::memcpy(index, mesh.faces.data(), 12 * mesh.faces.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene);
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_OFF);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_OFF);
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  static RTCRay ray(Rays& rays, std::size_t k, float near) {
    Vec3 const o = rays.origin.arrays().get(k), d = rays.direction.arrays().get(k);
    RTCRay out{};
    out.org_x = static_cast<float>(o.x);
    out.org_y = static_cast<float>(o.y);
    out.org_z = static_cast<float>(o.z);
    out.dir_x = static_cast<float>(d.x);
    out.dir_y = static_cast<float>(d.y);
    out.dir_z = static_cast<float>(d.z);
    out.tnear = near;
    out.tfar = static_cast<float>(rays.until[k]);
    out.mask = 0xffffffff;
    return out;
  }
  double closest(Rays& rays) const {
    return time_of(rays.count, [&](std::size_t first) {
      for (std::size_t k = first; k < std::min(first + batch, rays.count); ++k) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit hit{};
        hit.ray = ray(rays, k, 0);
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &hit);
      }
    });
  }
  double occluded(Rays& rays) const {
    return time_of(rays.count, [&](std::size_t first) {
      for (std::size_t k = first; k < std::min(first + batch, rays.count); ++k) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay shadow = ray(rays, k, 1e-4F);
        rtcOccluded1(scene, &context, &shadow);
      }
    });
  }
};
#endif

void measure(Scene scene) {
  std::vector<World::Solid>& solids = scene.solids;
  for (std::size_t i = 0; scene.solids.empty() && i < scene.shapes.size(); ++i) {
    solids.resize(scene.shapes.size());
    for (PrimitiveId id = 0; id < solids.size(); ++id) solids[id].tree.primitive = id;
  }
  auto const start = Clock::now();
  World const world(scene.shapes, solids);
  ScratchPtr const scratch = World::make_scratch();
  Rays camera, shadow, onward;
  look(scene, camera);
  Hits hits;
  Vec3 const lamp(-40, 60, -50);
  std::size_t unclear = 0, blocked = 0;
  // A mesh builds its hierarchy when it is first asked.
  world.intersect(camera.lines(pixels / 2), 1, nullptr, *scratch, hits);
  double const build = std::chrono::duration<double>(Clock::now() - start).count();
  for (std::size_t first = 0; first < camera.count; first += batch) {
    RayLines const lines = camera.lines(first);
    world.intersect(lines, 1, nullptr, *scratch, hits);
    for (std::size_t k = 0; k < lines.count; ++k) {
      RayHit const& hit = hits.hit[k];
      unclear += hit.kind == RayHit::Kind::Group ? 1 : 0;
      if (hit.kind != RayHit::Kind::Single) continue;
      std::size_t const through = onward.count++;
      onward.origin.arrays().set(through, hits.point.get(k));
      onward.error.arrays().set(through, hits.point_error.get(k));
      onward.direction.arrays().set(through, lines.direction.get(k));
      onward.start[through] = {hit.primitive, hit.face, RayStart::Kind::Surface, hit.was_entering,
                               true};
      Vec3 const point = hits.point.get(k), way = lamp - point;
      Vec3 const normal = world.normal(hit.primitive, hit.face, point);
      if ((glm::dot(normal, way) > 0) != (glm::dot(normal, lines.direction.get(k)) < 0)) continue;
      std::size_t const to = shadow.count++;
      shadow.origin.arrays().set(to, point);
      shadow.error.arrays().set(to, hits.point_error.get(k));
      shadow.direction.arrays().set(to, glm::normalize(way));
      shadow.until[to] = glm::length(way);
      shadow.start[to] = {hit.primitive, hit.face, RayStart::Kind::Surface, hit.was_entering,
                          false};
    }
  }
  std::vector<std::uint8_t> is(batch);
  std::vector<Hits> seen((camera.count + batch - 1) / batch);
  for (std::size_t k = 0; k < seen.size(); ++k)
    world.intersect(camera.lines(k * batch), 1, nullptr, *scratch, seen[k]);
  Vectors smoothed, geometric;
  double const normals = time_of(camera.count, [&](std::size_t first) {
    Hits const& of = seen[first / batch];
    world.normals(camera.lines(first).count, of.hit.data(), of.point, smoothed.arrays(),
                  geometric.arrays());
  });
  double const closest = time_of(camera.count, [&](std::size_t first) {
    world.intersect(camera.lines(first), 1, nullptr, *scratch, hits);
  });
  double const beyond = time_of(onward.count, [&](std::size_t first) {
    world.intersect(onward.lines(first), 1, nullptr, *scratch, hits);
  });
  double const occluded = time_of(shadow.count, [&](std::size_t first) {
    RayLines const lines = shadow.lines(first);
    world.occluded(lines, 4, shadow.until.data() + first, *scratch, is.data());
    for (std::size_t k = 0; k < lines.count; ++k) blocked += is[k];
  });
  blocked /= runs;
  auto const mean = [&](double c, double o) {
    return (c * static_cast<double>(camera.count) + o * static_cast<double>(shadow.count))
           / static_cast<double>(camera.count + shadow.count);
  };
  std::printf("%s: built in %.2f s; %zu camera rays (%zu unclear) %.0f ns, %zu shadow rays (%zu "
              "blocked) %.0f ns; mean %.0f ns; %zu rays on %.0f ns; normals %.1f ns\n",
              scene.name.c_str(), build, camera.count, unclear, closest, shadow.count, blocked,
              occluded, mean(closest, occluded), onward.count, beyond, normals);
#if ABBE_HAS_EMBREE
  if (scene.mesh.faces.empty()) return;
  Embree const embree(scene.mesh);
  double const c = embree.closest(camera), o = embree.occluded(shadow);
  std::printf(
      "  Embree: camera %.0f ns, shadow %.0f ns; mean %.0f ns: abbe takes %.2f times that\n", c, o,
      mean(c, o), mean(closest, occluded) / mean(c, o));
#endif
}

} // namespace
} // namespace abbe::geometry

int main(int count, char** names) {
  namespace here = abbe::geometry;
  auto const wanted = [&](std::string const& name) {
    return count < 2 || std::find(names + 1, names + count, name) != names + count;
  };
  if (wanted("glassy")) here::measure(here::glassy());
  if (wanted("waves")) here::measure(here::waves(708, false));
  if (wanted("smooth")) here::measure(here::waves(708, true));
  for (int const number : {100, 10000, 1000000})
    if (wanted("spheres" + std::to_string(number))) here::measure(here::spheres(number));
}
