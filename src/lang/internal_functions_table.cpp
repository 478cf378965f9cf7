// SPDX-License-Identifier: MIT
// The functions of functions.inc in the language of functions, after x, y and z the parameters a,
// b, c ... Each was found from values that POV-Ray prints and agrees with them to twelve decimals
// (tests/unit/lang/internal_functions_test.cpp); most are the implicit equations of surfaces that
// geometry knows under these names, times the strength of the field, kept within -10 .. 10.
#include "lang/internal_functions.hpp"

namespace abbe::lang {

namespace {

constexpr int helper = -1; ///< is called by others

constexpr InternalFunction table[] = {
    {helper, "within", "(x, y) { max(-y, min(y, x)) }"},
    {helper, "square_sum", "(x, y, z) { x*x + y*y + z*z }"},
    // A curve in the plane, or (a > 0) what comes of it when it is turned about the y axis, b away
    // from it and tilted by c degrees.
    {helper, "turned_x",
     "(x, y, z, a, b, c) { select(-a, (sqrt(x*x + z*z) - b)*cos(radians(c)) - y*sin(radians(c)), "
     "x, x) }"},
    {helper, "turned_y",
     "(x, y, z, a, b, c) { select(-a, (sqrt(x*x + z*z) - b)*sin(radians(c)) + y*cos(radians(c)), "
     "y, y) }"},
    // A cross-section: 0 a square, 1 a circle, 2 a diamond, others between and beyond.
    {helper, "section",
     "(x, y, a) { select(a, 0, max(abs(x), abs(y)), select(a - 1, pow(pow(abs(x), 2/a) + "
     "pow(abs(y), 2/a), a/2), sqrt(x*x + y*y), pow(pow(abs(x), 2/a) + pow(abs(y), 2/a), a/2))) }"},
    // The way from the middle of the nearest of pieces that are y long.
    {helper, "off_middle", "(x, y) { x - y*floor(x/y + .5) }"},

    {helper, "cylinder_1", "(x, y) { y*y + x*x*(abs(x) - 1) }"},
    {helper, "cylinder_2", "(x, y) { 3*x*x*y - 2*sqr(x*x) - sqr(y - y*y) }"},
    {helper, "cylinder_3", "(x, y) { x*y*y + 2*x*x*y - y*y - x*x*y*y - sqr(x*x) }"},
    {helper, "cylinder_4", "(x, y) { y*y*y - 3*x*x*y - sqr(x*x + y*y) }"},
    {0, "",
     "(x, y, z, a, b, c, d, e) { within(a*cylinder_1(turned_x(x,y,z,c,d,e), "
     "turned_y(x,y,z,c,d,e)), b) }"},
    {1, "",
     "(x, y, z, a, b, c, d, e) { within(a*cylinder_2(turned_x(x,y,z,c,d,e), "
     "turned_y(x,y,z,c,d,e)), b) }"},
    {2, "",
     "(x, y, z, a, b, c, d, e) { within(a*cylinder_3(turned_x(x,y,z,c,d,e), "
     "turned_y(x,y,z,c,d,e)), b) }"},
    {3, "",
     "(x, y, z, a, b, c, d, e) { within(a*cylinder_4(turned_x(x,y,z,c,d,e), "
     "turned_y(x,y,z,c,d,e)), b) }"},
    {4, "",
     "(x, y, z, a, b) { within(a*(y*y*(b*b - x*x - z*z) - sqr(x*x + z*z + 2*b*y - b*b)), 10) }"},
    {5, "", "(x, y, z, a, b) { within(a*(b*y*(x*x + z*z) - sqr(square_sum(x,y,z))), 10) }"},
    {helper, "blob_part", "(x, y, z, a) { sqr(max(0, 1 - a*a*square_sum(x,y,z))) }"},
    {6, "",
     "(x, y, z, a, b, c, d, e) { -b*blob_part(x + a/2, y, z, c) - d*blob_part(x - a/2, y, z, e) }"},
    {7, "",
     "(x, y, z, a, b, c, d) { d - c*(exp(-b*square_sum(x,y,z)) + exp(-b*square_sum(x - a,y,z))) }"},
    {8, "",
     "(x, y, z, a, b) { within(a*b*(64*pow(1 - z, 3)*z*z*z - 48*sqr(1 - z)*z*z*(3*x*x + 3*y*y + "
     "2*z*z)"
     " + 12*(1 - z)*z*(27*sqr(x*x + y*y) - 24*z*z*(x*x + y*y) + 36*sqrt(2)*y*z*(y*y - 3*x*x) + "
     "4*sqr(z*z))"
     " + (9*x*x + 9*y*y - 2*z*z)*(-81*sqr(x*x + y*y) - 72*z*z*(x*x + y*y) + 108*sqrt(2)*x*z*(x*x - "
     "3*y*y) + 4*sqr(z*z))), 10) }"},
    {helper, "ellipsoid_x", "(x, y, z, a) { x*x + a*(y*y + z*z) }"},
    {10, "",
     "(x, y, z, a, b, c, d) { d - c*exp(-b*min(ellipsoid_x(x,y,z,a), ellipsoid_x(y,x,z,a), "
     "ellipsoid_x(z,x,y,a))) }"},
    {11, "", "(x, y, z, a) { within(a*(x*x*z*z - y), 10) }"},
    {12, "", "(x, y, z, a) { within(a*(z + y*y*y - x*x*x), 10) }"},
    {13, "",
     "(x, y, z, a) { within(a*(z*z*x*x - sqr(z*z) - 2*z*x*x + 2*z*z*z + x*x - z*z - sqr(x*x - z) - "
     "sqr(y*y) - 2*x*x*y*y - y*y*z*z + 2*y*y*z + y*y), 10) }"},
    {14, "", "(x, y, z, a) { within(a*(sqr(y*y) - .25*y*y - sqr(x*x + z*z) + .36*x*x), 10) }"},
    {helper, "devil", "(x, y, a, b) { y*y*(y*y - b*b) - x*x*(x*x - a*a) }"},
    {15, "",
     "(x, y, z, a, b, c, d, e, f) { within(a*devil(turned_x(x,y,z,d,e,f), turned_y(x,y,z,d,e,f), "
     "b, c), 10) }"},
    // The torus after an inversion; its share of y is moved the other way, as in POV-Ray.
    {helper, "cyclide",
     "(x, y, z, a, b, c, d, e, f) { 2*(a*a + b*b)*(sqr(e*e*x - c*f) + sqr(e*e*z)) - 2*(a*a - "
     "b*b)*sqr(e*e*y + d*f)"
     " - sqr(a*a - b*b)*f*f - sqr(sqr(e*e) - 2*e*e*(c*x + d*y) + (c*c + d*d)*f) }"},
    {16, "",
     "(x, y, z, a, b, c, d, e, f) { within(a*cyclide(x, y, z, b, c, d, e, f, square_sum(x,y,z)), "
     "10) }"},
    {17, "", "(x, y, z, a, b, c) { sqrt(square_sum(a*x, b*y, c*z)) }"},
    {19, "",
     "(x, y, z, a, b, c, d) { d - c*(exp(-b*ellipsoid_x(x,y,z,a)) + exp(-b*ellipsoid_x(y,x,z,a)) + "
     "exp(-b*ellipsoid_x(z,x,y,a))) }"},
    {20, "", "(x, y, z, a, b, c) { within(a*((y*y + z*z)*(1 - (4*b - c)*x) + (1 + c)*x*x), 10) }"},
    {helper, "folium", "(x, y, a, b) { y*y*((4*a - b)*x - 1) - (1 + b)*x*x }"},
    {21, "",
     "(x, y, z, a, b, c, d, e, f) { within(a*folium(turned_x(x,y,z,d,e,f), turned_y(x,y,z,d,e,f), "
     "b, c), 10) }"},
    {22, "", "(x, y, z, a) { within(a*(.5*x*x*x*x*(x + 1) - y*y - z*z), 10) }"},
    {23, "",
     "(x, y, z, a) { within(a*((.1*x*x + y*y)*z*z*z - pow(2*x*x + y*y + z*z - 1, 3)), 10) }"},
    {helper, "turned_section",
     "(x, y, a, b) { section(x*cos(b) - y*sin(b), x*sin(b) + y*cos(b), a) }"},
    {25, "",
     "(x, y, z, a, b, c, d, e, f, g) { min(sqrt(x*x + z*z) + d, turned_section(sqrt(x*x + z*z) - d,"
     " off_middle(atan2(z, x) + b*y - pi/a, 2*pi/a)/(b*e), f, radians(g))) - c }"},
    {26, "",
     "(x, y, z, a, b, c, d, e, f, g) { turned_section(x - d*cos(b*y), z - d*sin(b*y), f, -b*y) - c "
     "}"},
    // From the middle of the nearest of hexagons with corners up and down, sides 1: the way to the
    // side that it is next to, and the way along this side.
    {helper, "to_side", "(x, y) { max(abs(x), abs(x/2 + sqrt(.75)*y), abs(x/2 - sqrt(.75)*y)) }"},
    {helper, "along_side",
     "(x, y) { select(max(abs(x/2 + sqrt(.75)*y), abs(x/2 - sqrt(.75)*y)) - abs(x), abs(y),"
     " select(abs(x/2 - sqrt(.75)*y) - abs(x/2 + sqrt(.75)*y), abs(sqrt(.75)*x - y/2), "
     "abs(sqrt(.75)*x + y/2))) }"},
    {helper, "hexagon_y",
     "(x, y, a, b) { select(to_side(x, y) - to_side(a, b), along_side(x, y), along_side(a, b)) }"},
    {27, "",
     "(x, y, z, a) { min(to_side(off_middle(x, sqrt(3)), off_middle(y, 3)), to_side(off_middle(x - "
     "sqrt(.75), sqrt(3)), off_middle(y - 1.5, 3))) }"},
    {28, "",
     "(x, y, z, a) { hexagon_y(off_middle(x, sqrt(3)), off_middle(y, 3), off_middle(x - sqrt(.75), "
     "sqrt(3)), off_middle(y - 1.5, 3)) }"},
    {30, "",
     "(x, y, z, a) { within(-a*(4*pow(square_sum(x,y,z) - 13, 3) + 27*sqr(3*x*x + y*y - 4*z*z - "
     "12)), 10) }"},
    {31, "",
     "(x, y, z, a, b, c) { within(a*(4*b*b*(x*x - z*z) - sqr(x*x + y*y - z*z + b*b - c*c)), 10) }"},
    {32, "",
     "(x, y, z, a, b, c, d) { d - c*exp(-b*max(ellipsoid_x(x,y,z,a), ellipsoid_x(y,x,z,a), "
     "ellipsoid_x(z,x,y,a))) }"},
    {33, "", "(x, y, z, a, b, c) { within(a*(c*c*x*x*(x*x - b*b) - y*y - z*z), 10) }"},
    {helper, "kampyle", "(x, y, a, b) { b*b*x*x*(x*x - a*b) - y*y }"},
    {34, "",
     "(x, y, z, a, b, c, d, e, f) { within(a*kampyle(turned_x(x,y,z,d,e,f), turned_y(x,y,z,d,e,f), "
     "b, c), 10) }"},
    {helper, "klein", "(x, y, z, a) { (a + 2*y)*(sqr(a - 2*y) - 8*z*z) + 16*x*z*(a - 2*y) }"},
    {35, "", "(x, y, z, a) { within(-a*klein(x, y, z, square_sum(x,y,z) - 1), 10) }"},
    {helper, "kummer",
     "(x, y, z, a, b, c) { x*x*x*x + y*y*y*y + z*z*z*z + a*(x*x + y*y + z*z) + b*(x*x*y*y + "
     "y*y*z*z + z*z*x*x) + c*x*y*z }"},
    {36, "", "(x, y, z, a) { within(-a*(kummer(x, y, z, -1, -1, 0) + 1), 10) }"},
    {37, "", "(x, y, z, a, b, c, d) { within(-a*(kummer(x, y, z, b, c, d) - 1), 10) }"},
    {38, "", "(x, y, z, a) { within(a*(x*x*(1 - x*x) - y*y - z*z), 10) }"},
    {helper, "gerono", "(x, y, a, b) { b*b*x*x*(a*a - x*x) - y*y }"},
    {39, "",
     "(x, y, z, a, b, c, d, e, f) { within(a*gerono(turned_x(x,y,z,d,e,f), turned_y(x,y,z,d,e,f), "
     "b, c), 10) }"},
    // Every other thread along z, woven with those across it.
    {helper, "thread",
     "(x, y, z, a, b, c, d, e) { sqrt(sqr(e*(y + d*cos(pi*z/b))) + sqr(c*off_middle(x, 2*a))) }"},
    {40, "",
     "(x, y, z, a, b, c, d, e) { min(thread(x,y,z,a,b,c,d,e), thread(x - a,y,z,a,b,c,-d,e), "
     "thread(z,y,x,b,a,c,-d,e), thread(z - b,y,x,b,a,c,d,e)) }"},
    {41, "", "(x, y, z, a) { within(a*(y*y*(1 - y*y - z*z) - 4*x*x*square_sum(x,y,z)), 10) }"},
    {42, "", "(x, y, z, a) { within(a*(6*y*z - y*y*y - z*z*z), 10) }"},
    {43, "",
     "(x, y, z, a) { within(a*(z*z*x*x - sqr(z*z) - 2*z*x*x + 2*z*z*z + x*x - z*z - sqr(x*x - z) - "
     "sqr(y*y) - 2*x*x*y*y - y*y*z*z + 2*y*y*z + y*y), 10) }"},
    {44, "",
     "(x, y, z, a, b, c, d) { within(a*(c*c + d*b*b*(x*x + z*z) - sqr(square_sum(x,y,z) + b*b)), "
     "10) }"},
    {45, "", "(x, y, z, a) { within(a*(y - x*x - z*z), 10) }"},
    {46, "",
     "(x, y, z, a, b, c) { within(a*((b*b + c*c)*(x*x - z) - sqr(x*x + y*y - z) - (b*b - c*c)*y*y "
     "- sqr(b*b - c*c)), 10) }"},
    {47, "", "(x, y, z) { atan2(sqrt(x*x + z*z), y) }"},
    {48, "", "(x, y, z, a) { within(a*(x*x*x*x + y*y*y*y + z*z*z*z - square_sum(x,y,z)), 10) }"},
    {49, "", "(x, y, z, a) { within(a*(x*x*x*(x - 1) + y*y + z*z), 10) }"},
    {helper, "piriform", "(x, y, a, b, c) { c*c*x*x*x*(a + b*x) - y*y }"},
    {50, "",
     "(x, y, z, a, b, c, d, e, f, g) { within(a*piriform(turned_x(x,y,z,e,f,g), "
     "turned_y(x,y,z,e,f,g), b, c, d), 10) }"},
    {helper, "fourth_degree", "(x, a, b, c, d, e) { a + x*(b + x*(c + x*(d + x*e))) }"},
    {51, "", "(x, y, z, a, b, c, d, e) { sqrt(x*x + z*z) - fourth_degree(y,a,b,c,d,e) }"},
    {helper, "to_tube",
     "(x, y, a, b) { sqrt(sqr(x*sin(off_middle(y, a))) + sqr(x*cos(off_middle(y, a)) - abs(b))) }"},
    {52, "",
     "(x, y, z, a, b, c, d, e, f) { to_tube(sqrt(x*x + z*z), atan2(x, z) + "
     "select(fourth_degree(y,b,c,d,e,f), pi, 0), 2*pi/a, fourth_degree(y,b,c,d,e,f)) }"},
    {53, "",
     "(x, y, z, a) { 1.2 - 1.6*exp(-1.33333332*sqrt(square_sum(x,y,z)))*sqr(2*y*y - x*x - z*z) }"},
    {54, "", "(x, y, z, a) { within(a*(y - x*x*x*x - z*z*z*z), 10) }"},
    {55, "", "(x, y, z, a) { within(a*(y + z*z*z*z - x*x*x*x), 10) }"},
    {56, "", "(x, y, z, a, b, c) { within(a*(b*b*c*c - (x*x + z*z)*(y*y + c*c)), 10) }"},
    {57, "", "(x, y, z) { sqrt(square_sum(x,y,z)) }"},
    // Octaves of noise as ridges at the value b, and how far their mean is above c, at most 1.
    {helper, "ridge", "(x, a) { select(x - a, x/a, (1 - x)/(1 - a)) }"},
    {58, "",
     "(x, y, z, a, b, c, d, e, f) { (1 - d - sum(i, 0, b - 1, pow(c, i)*ridge(noise(x*pow(a, i), "
     "y*pow(a, i), z*pow(a, i), f), e))"
     "/sum(i, 0, b - 1, pow(c, i)))/max(d, 1 - d) }"},
    {60, "",
     "(x, y, z, a, b, c, d) { sqrt(sqr(max(abs(x) - b + a, 0)) + sqr(max(abs(y) - c + a, 0)) + "
     "sqr(max(abs(z) - d + a, 0))) - a - .000001 }"},
    {61, "", "(x, y, z, a) { sqrt(square_sum(x,y,z)) - a }"},
    {62, "",
     "(x, y, z, a, b, c, d, e) { c*(exp(-b*ellipsoid_x(x,y,z,a)) + exp(-b*ellipsoid_x(y,x,z,a)) + "
     "exp(-b*ellipsoid_x(z,x,y,a))"
     " - e*exp(-d*square_sum(x,y,z))) }"},
    {63, "", "(x, y, z, a, b, c, d) { y - a*cos(b*x)*cos(c*z)*exp(-d*(x*x + z*z)) }"},
    {64, "",
     "(x, y, z, a, b, c, d, e, f) { max(min(sqrt(square_sum(x,y,z)), section(off_middle(sqrt(x*x + "
     "z*z) + a*(atan2(z, x)/(2*pi) - .5), a), y, f)) - b, sqrt(square_sum(x,y,z)) - c) }"},
    {65, "", "(x, y, z, a) { within(-a*(x*x*z*z + x*x*y*y + y*y*z*z + x*y*z), 10) }"},
    {66, "", "(x, y, z, a, b, c, d) { within(a*((x - c)*(y*y + z*z) + d*d*x*x*(x + b)), 10) }"},
    {helper, "strophoid", "(x, y, a, b, c) { (x - b)*y*y + c*c*x*x*(x + a) }"},
    {67, "",
     "(x, y, z, a, b, c, d, e, f, g) { within(a*strophoid(turned_x(x,y,z,e,f,g), "
     "turned_y(x,y,z,e,f,g), b, c, d), 10) }"},
    {68, "",
     "(x, y, z, a, b) { 1 - pow(pow(pow(abs(x), 2/a) + pow(abs(y), 2/a), a/b) + pow(abs(z), 2/b), "
     "b/2) }"},
    {69, "", "(x, y, z) { atan2(x, z) }"},
    {70, "", "(x, y, z, a, b) { sqrt(sqr(sqrt(x*x + z*z) - a) + y*y) - b }"},
    {71, "",
     "(x, y, z, a, b, c) { within(a*(4*b*b*(x*x + z*z) - sqr(square_sum(x,y,z) + b*b - c*c)), 10) "
     "}"},
    {72, "",
     "(x, y, z, a) { within(-a*(4*(x*x*x*x + sqr(y*y + z*z)) + 17*x*x*(y*y + z*z) - "
     "20*square_sum(x,y,z) + 17), 10) }"},
    {73, "", "(x, y, z, a) { within(a*(y*z*z - x*x), 10) }"},
    {74, "", "(x, y, z, a, b) { within(a*(b - y*(b + x*x + z*z)), 10) }"},
    {helper, "agnesi", "(x, y, a, b) { b - y*(a*a + x*x) }"},
    {75, "",
     "(x, y, z, a, b, c, d, e, f) { within(a*agnesi(turned_x(x,y,z,d,e,f), turned_y(x,y,z,d,e,f), "
     "b, c), 10) }"},
};

} // namespace

std::span<InternalFunction const> internal_functions() {
  return table;
}

} // namespace abbe::lang
