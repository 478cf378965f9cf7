// SPDX-License-Identifier: MIT
#include "geometry/transform.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

/// What a Transform says that it is off by, against the same chain in 50 digits.
namespace abbe::geometry {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;
using ExactVec = std::array<Exact, 3>;
using ExactMat = std::array<ExactVec, 3>; ///< rows

struct Step {
  enum class Kind { Translate, Rotate, Scale } kind = Kind::Translate;
  Vec3 v{0};
};

ExactMat multiply(ExactMat const& a, ExactMat const& b) {
  ExactMat out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
  }
  return out;
}
ExactVec multiply(ExactMat const& a, ExactVec const& v) {
  ExactVec out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = a[i][0] * v[0] + a[i][1] * v[1] + a[i][2] * v[2];
  return out;
}
ExactMat transposed(ExactMat const& a) {
  ExactMat out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = a[j][i];
  }
  return out;
}
ExactMat diagonal(Exact const& x, Exact const& y, Exact const& z) {
  return {ExactVec{x, 0, 0}, ExactVec{0, y, 0}, ExactVec{0, 0, z}};
}

/// POV-Ray's rotate, in the column convention: about x, then y, then z.
ExactMat rotation(Vec3 const& degrees) {
  ExactMat result = diagonal(1, 1, 1);
  for (int axis = 0; axis < 3; ++axis) {
    Exact const angle = Exact(degrees[axis]) * boost::math::constants::pi<Exact>() / 180;
    Exact const s = sin(angle), c = cos(angle);
    auto const a = static_cast<std::size_t>((axis + 1) % 3);
    auto const b = static_cast<std::size_t>((axis + 2) % 3);
    ExactMat one = diagonal(1, 1, 1);
    one[a][a] = one[b][b] = c;
    one[a][b] = -s;
    one[b][a] = s;
    result = multiply(one, result);
  }
  return result;
}

struct ExactTransform {
  ExactMat linear = diagonal(1, 1, 1), inverse = diagonal(1, 1, 1);
  ExactVec offset{0, 0, 0};

  void apply(Step const& step) {
    ExactMat by = diagonal(1, 1, 1), back = by;
    if (step.kind == Step::Kind::Rotate) {
      by = rotation(step.v);
      back = transposed(by);
    } else if (step.kind == Step::Kind::Scale) {
      by = diagonal(step.v.x, step.v.y, step.v.z);
      back = diagonal(1 / Exact(step.v.x), 1 / Exact(step.v.y), 1 / Exact(step.v.z));
    } else {
      for (std::size_t i = 0; i < 3; ++i) offset[i] += Exact(step.v[static_cast<int>(i)]);
      return;
    }
    linear = multiply(by, linear);
    offset = multiply(by, offset);
    inverse = multiply(inverse, back);
  }
};

Transform of(Step const& step) {
  switch (step.kind) {
  case Step::Kind::Rotate:
    return Transform::rotation(step.v);
  case Step::Kind::Scale:
    return Transform::scaling(step.v);
  default:
    return Transform::translation(step.v);
  }
}

/// The largest true error and the largest bound among entries that belong together.
struct Worst {
  double error = 0, bound = 0, size = 0;
  bool held = true;
  void meet(Exact const& exact, double value, double bound_here) {
    Exact const off = abs(Exact(value) - exact);
    held = held && off <= Exact(bound_here);
    error = std::max(error, static_cast<double>(off));
    bound = std::max(bound, bound_here);
    size = std::max(size, std::fabs(value));
  }
};
struct Errors {
  Worst linear, offset, inverse, inverse_offset;
};
Errors errors_of(Transform const& t, ExactTransform const& exact) {
  Errors out;
  ExactVec const back = multiply(exact.inverse, exact.offset);
  for (int i = 0; i < 3; ++i) {
    auto const row = static_cast<std::size_t>(i);
    out.offset.meet(exact.offset[row], t.offset[i], t.offset_error[i]);
    out.inverse_offset.meet(-back[row], t.inverse_offset[i], t.inverse_offset_error[i]);
    for (int j = 0; j < 3; ++j) {
      auto const column = static_cast<std::size_t>(j);
      out.linear.meet(exact.linear[row][column], t.linear[j][i], t.linear_error[j][i]);
      out.inverse.meet(exact.inverse[row][column], t.inverse_linear[j][i],
                       t.inverse_linear_error[j][i]);
    }
  }
  return out;
}

/// Numbers as scenes have them: few digits, any size.
rc::Gen<double> any_number(double largest) {
  return rc::gen::map(rc::gen::inRange(-100000, 100001), [=](int n) { return n * 1e-5 * largest; });
}
rc::Gen<Step> any_step() {
  return rc::gen::exec([] {
    Step step;
    step.kind = *rc::gen::element(Step::Kind::Translate, Step::Kind::Rotate, Step::Kind::Scale);
    for (int i = 0; i < 3; ++i) {
      if (step.kind == Step::Kind::Translate) {
        step.v[i] = *any_number(std::pow(10, *rc::gen::inRange(-3, 7)));
      } else if (step.kind == Step::Kind::Rotate) {
        step.v[i] = *rc::gen::weightedOneOf<double>(
            {{1, rc::gen::just(0.0)}, {1, rc::gen::just(90.0)}, {2, any_number(720)}});
      } else {
        step.v[i] = std::exp2(*any_number(3));
      }
    }
    return step;
  });
}

RC_GTEST_PROP(TransformBounds, HoldForChainsOfAnyLength, ()) {
  auto const steps = *rc::gen::container<std::vector<Step>>(*rc::gen::inRange(1, 24), any_step());
  Transform chain;
  ExactTransform exact;
  for (Step const& step : steps) {
    chain = chain.then(of(step));
    exact.apply(step);
  }
  Errors const errors = errors_of(chain, exact);
  RC_ASSERT(errors.linear.held && errors.offset.held && errors.inverse.held
            && errors.inverse_offset.held);
  Errors const back = errors_of(chain.inverse().inverse(), exact);
  RC_ASSERT(back.linear.held && back.offset.held && back.inverse.held && back.inverse_offset.held);
}

RC_GTEST_PROP(TransformBounds, ScaleWithTheScene, ()) {
  auto const steps = *rc::gen::container<std::vector<Step>>(5, any_step());
  int const k = *rc::gen::inRange(-60, 61);
  double const size = std::ldexp(1.0, k);
  Transform plain, scaled = Transform::scaling(Vec3(size));
  for (Step step : steps) {
    plain = plain.then(of(step));
    if (step.kind == Step::Kind::Translate) step.v *= size;
    scaled = scaled.then(of(step));
  }
  RC_ASSERT(scaled.offset == plain.offset * size);
  RC_ASSERT(scaled.offset_error == plain.offset_error * size);
  RC_ASSERT(scaled.linear_error == plain.linear_error * size);
  RC_ASSERT(scaled.inverse_linear_error == plain.inverse_linear_error / size);
}

/// Bounds that are far too large would make one event of what is two. A chain may be lucky, so the
/// largest error of many chains of one kind counts.
TEST(TransformBounds, AreWithinFiftyTimesTheErrorsThatHappen) {
  // POV-Ray-like: to a place, turned there, and away again; once, and three times in a row.
  for (int const rounds : {1, 3}) {
    Errors most;
    for (int i = 1; i <= 2000; ++i) {
      Transform chain;
      ExactTransform exact;
      for (int round = 0; round < rounds; ++round) {
        double const a = std::fmod(i * 0.7548776662, 1.0), b = std::fmod(i * 0.5698402910, 1.0);
        Vec3 const place(1000 + a, -1000 - b, 1000 + a * b);
        for (Step const& step :
             {Step{Step::Kind::Translate, -place},
              Step{Step::Kind::Rotate, {a * 360, b * 360, a * 77}},
              Step{Step::Kind::Scale, {1 + a, 1 + b, 2 - a}}, Step{Step::Kind::Translate, place}}) {
          chain = chain.then(of(step));
          exact.apply(step);
        }
      }
      Errors const errors = errors_of(chain, exact);
      for (auto const member :
           {&Errors::linear, &Errors::offset, &Errors::inverse, &Errors::inverse_offset}) {
        Worst& worst = most.*member;
        Worst const& here = errors.*member;
        ASSERT_TRUE(here.held);
        worst.error = std::max(worst.error, here.error);
        worst.bound = std::max(worst.bound, here.bound);
      }
    }
    for (auto const member :
         {&Errors::linear, &Errors::offset, &Errors::inverse, &Errors::inverse_offset}) {
      EXPECT_LE((most.*member).bound, 50 * (most.*member).error) << rounds;
    }
  }
}

TEST(TransformBounds, AreZeroForExactSteps) {
  Transform const chain = Transform::scaling({2, 0.25, 4})
                              .then(Transform::translation({0.5, -3, 1e6}))
                              .then(Transform::rotation({90, -180, 630}))
                              .then(Transform::translation({0.25, 7, 0}));
  EXPECT_EQ(chain.offset_error, Vec3(0));
  EXPECT_EQ(chain.inverse_offset_error, Vec3(0));
  EXPECT_EQ(chain.linear_error, Mat3(0));
  EXPECT_EQ(chain.inverse_linear_error, Mat3(0));
}

TEST(TransformBounds, HoldForMatrices) {
  // Nearly singular, and written out: the inverse by Cramer's rule in 50 digits.
  double const rows[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9.0000001, 10, 20, 30};
  Transform const t = *Transform::matrix(rows);
  ExactTransform exact;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) exact.linear[i][j] = rows[3 * j + i];
    exact.offset[i] = rows[9 + i];
  }
  auto const& m = exact.linear;
  auto const minor = [&](std::size_t r, std::size_t c) {
    return Exact(m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3]
                 - m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3]);
  };
  Exact const determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) exact.inverse[i][j] = minor(j, i) / determinant;
  }
  Errors const errors = errors_of(t, exact);
  EXPECT_TRUE(errors.inverse.held);
  EXPECT_TRUE(errors.inverse_offset.held);
  EXPECT_LT(errors.inverse.bound, 1e-5 * errors.inverse.size);
}

} // namespace
} // namespace abbe::geometry
