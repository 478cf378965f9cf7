// SPDX-License-Identifier: MIT
#pragma once

#include "optics/lane.hpp"

namespace abbe::optics {

/// A plane interface between two clear media met by a ray of one wavelength (or, with a vector type
/// L, of one wavelength per lane): what passes, what returns, and where the refracted ray goes.
template <class L>
struct Interface {
  L cos_t;         ///< cosine of the angle of refraction, >= 0; 0 at total reflection
  L eta;           ///< n1 / n2
  L bend;          ///< refracted direction = eta D + bend N, N against D
  L reflectance;   ///< of unpolarised light, 0..1
  L transmittance; ///< computed by itself, not as 1 - reflectance: keeps its digits at grazing
                   ///< incidence
  MaskOf<L> total; ///< total internal reflection: reflectance 1, transmittance 0
};

namespace detail {

/// Power reflected and transmitted by one polarisation with admittance terms a (incident side) and
/// b:
/// ((a - b)/(a + b))^2 and 4ab/(a + b)^2. Where a and b are close, a - b comes in as the given
/// difference of squares over a + b; elsewhere a - b has no cancellation, and using it makes R and
/// T consistent with one another whatever the rounding of b (near the critical angle it is large).
template <class L>
void polarised(L const& a, L const& b, L const& difference_of_squares, L& reflected,
               L& transmitted) {
  L const sum = a + b;
  MaskOf<L> const close = (L(0.75) * a < b) & (L(0.75) * b < a);
  L const difference = select(close, difference_of_squares / sum, a - b);
  L const amplitude = difference / sum;
  reflected = amplitude * amplitude;
  transmitted = L(4.0) * (a / sum) * (b / sum);
}

} // namespace detail

/// Snell and Fresnel in difference form: no digits are lost when the indices nearly agree, at
/// normal or at grazing incidence.
/// @param n1 index on the side of the incident ray, > 0
/// @param n2 index on the other side, > 0
/// @param dn n2 - n1, given apart because the caller may know it better than the rounded indices do
/// @param cos_i cosine of the angle of incidence, in [0, 1]
/// @param sin2_i its squared sine, (1 - cos_i)(1 + cos_i) or |D x N|^2
/// With dn = 0 the ray passes untouched: eta 1, bend 0, cos_t = cos_i bitwise, reflectance 0.
/// @source research brief 3.6; Born & Wolf, Principles of Optics, 1.5.2
template <class L>
Interface<L> fresnel(L const& n1, L const& n2, L const& dn, L const& cos_i, L const& sin2_i) {
  L const sum = n1 + n2;
  L const eta = n1 / n2;
  L const contrast = (dn / n2) * (sum / n2); // 1 - eta^2
  L const scaled = eta * cos_i;
  L const cos2_t = contrast + scaled * scaled;
  MaskOf<L> const same = dn == L(0.0);
  // Grazing incidence between equal media is no total reflection.
  MaskOf<L> const total = (cos2_t <= L(0.0)) & !same;
  L const root = sqrt(select(total, L(0.0), cos2_t));
  L const cos_t = select(same, cos_i, root);

  L const square = dn * sum; // n2^2 - n1^2
  L reflected_s, transmitted_s, reflected_p, transmitted_p;
  detail::polarised(n1 * cos_i, n2 * cos_t, -square, reflected_s, transmitted_s);
  detail::polarised(n2 * cos_i, n1 * cos_t, square * (L(1.0) - sin2_i * (L(1.0) + eta * eta)),
                    reflected_p, transmitted_p);

  MaskOf<L> const close = (L(0.75) * scaled < cos_t) & (L(0.75) * cos_t < scaled);
  L const bend = select(close, -contrast / (scaled + cos_t), scaled - cos_t);
  L const half = L(0.5);
  Interface<L> result{
      cos_t, eta, bend, half * (reflected_s + reflected_p), half * (transmitted_s + transmitted_p),
      total};
  result.eta = select(same, L(1.0), result.eta);
  result.bend = select(same, L(0.0), result.bend);
  result.reflectance = select(total, L(1.0), select(same, L(0.0), result.reflectance));
  result.transmittance = select(total, L(0.0), select(same, L(1.0), result.transmittance));
  return result;
}

template <class L>
Interface<L> fresnel(L const& n1, L const& n2, L const& cos_i) {
  return fresnel<L>(n1, n2, n2 - n1, cos_i, (L(1.0) - cos_i) * (L(1.0) + cos_i));
}

/// Reflectance of unpolarised light by a metal of complex index n + i k (relative to the medium
/// outside), exact. @source Born & Wolf 14.2; the real form of D. Collett, Field Guide to
/// Polarization
template <class L>
L conductor_reflectance(L const& n, L const& k, L const& cos_i) {
  L const cos2 = cos_i * cos_i;
  L const sin2 = (L(1.0) - cos_i) * (L(1.0) + cos_i);
  L const n2 = n * n;
  L const k2 = k * k;
  L const t0 = n2 - k2 - sin2;
  L const twice_nk = L(2.0) * n * k;
  // (a + ib)^2 = (n + ik)^2 - sin^2; a^2 + b^2 first, then a from whichever sum does not cancel.
  L const a2_plus_b2 = sqrt(t0 * t0 + twice_nk * twice_nk);
  MaskOf<L> const positive = t0 > L(0.0);
  L const larger2 = L(0.5) * (a2_plus_b2 + select(positive, t0, -t0));
  L const larger = sqrt(larger2);
  L const safe = select(larger > L(0.0), larger, L(1.0));
  L const a = select(positive, larger, L(0.5) * twice_nk / safe);
  L const t1 = a2_plus_b2 + cos2;
  L const t2 = L(2.0) * a * cos_i;
  L const sum_s = t1 + t2;
  // 0 only for n = 1, k = 0 at grazing incidence: no interface.
  L const rs = select(sum_s > L(0.0), (t1 - t2) / select(sum_s > L(0.0), sum_s, L(1.0)), L(0.0));
  L const t3 = cos2 * a2_plus_b2 + sin2 * sin2;
  L const t4 = t2 * sin2;
  L const rp = rs * (t3 - t4) / (t3 + t4);
  return L(0.5) * (rs + rp);
}

} // namespace abbe::optics
