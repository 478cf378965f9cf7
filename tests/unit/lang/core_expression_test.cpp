// SPDX-License-Identifier: MIT
// Expected values: section 22 and the [T] marks of the language notes, and what `povray` 3.7.0.10
// prints for the same #debug line.
#include "core_run.hpp"

namespace abbe::lang {
namespace {

TEST(Expression, AndAndOrHaveTheSamePrecedence) {
  EXPECT_EQ(value_of("(1|1&0)"), "0.000000000000");
}

TEST(Expression, ComparisonsGroupFromTheLeft) {
  EXPECT_EQ(value_of("(1<2<1)"), "0.000000000000");
  EXPECT_EQ(value_of("(3>2>1)"), "0.000000000000");
}

TEST(Expression, EqualityHasATolerance) {
  EXPECT_EQ(value_of("(1=1.00000000001)"), "1.000000000000");
  EXPECT_EQ(value_of("(1<=0.99999999999)"), "1.000000000000");
  EXPECT_EQ(value_of("(1<0.99999999999)"), "0.000000000000");
}

TEST(Expression, SmallerOperandIsPromoted) {
  EXPECT_EQ(vector_of("<1,2>*<1,2,3>+1"), "2.000000,5.000000,1.000000");
  EXPECT_EQ(vector_of("(<1,2,3> < <2,2,2>)"), "1.000000,0.000000,0.000000");
}

TEST(Expression, MembersBindToOnePrimary) {
  EXPECT_EQ(
      said("#declare V=<1,2,3>; #declare A=array[1]{V} "
           "#debug concat(str(-V.x,0,0),str(<1,2,3>.y,0,0),str(A[0].z,0,0),str((V*2).z,0,0))"),
      "-1236");
}

TEST(Expression, VectorFunctions) {
  EXPECT_EQ(vector_of("vrotate(x,<90,90,0>)"), "0.000000,0.000000,-1.000000");
  EXPECT_EQ(vector_of("vrotate(x,90*z)"), "0.000000,1.000000,0.000000");
  EXPECT_EQ(vector_of("vaxis_rotate(x,y,90)"), "0.000000,0.000000,-1.000000");
  EXPECT_EQ(vector_of("vaxis_rotate(<1,2,3>,<1,1,0>,33)"), "2.236019,0.763981,2.901130");
  EXPECT_EQ(vector_of("vrotate(<1,2,3>,<10,20,30>)"), "1.067425,2.289059,2.760581");
  EXPECT_EQ(vector_of("vcross(x,y)"), "0.000000,0.000000,1.000000");
  EXPECT_EQ(vector_of("vturbulence(2,.5,6,<.3,.7,1.9>)"), "-0.316815,-0.473953,-0.150193");
}

TEST(Expression, FloatFunctions) {
  EXPECT_EQ(
      said("#debug concat(str(div(-7,2),0,0),\" \",str(mod(-7,3),0,2),\" \",str(int(-3.7),0,0),"
           "\" \",str(floor(-3.2),0,0),\" \",str(select(-1,1,2),0,0),str(select(0,1,2),0,0),"
           "str(select(0,1,2,3),0,0),\" \",str(bitwise_xor(5,3),0,0),\" \",str(max(3,1,2),0,0))"),
      "-3 -1.00 -3 -4 122 6 3");
}

TEST(Expression, RandomStreamsAreThoseOfPovRay) {
  EXPECT_EQ(said("#declare S=seed(0); #for(I,1,4) #debug concat(str(rand(S),0,12),\" \") #end"),
            "0.000002874294 0.466563684509 0.249070228834 0.965876042136 ");
  EXPECT_EQ(said("#declare S=seed(12345); #for(I,1,2) #debug concat(str(rand(S),0,12),\" \") #end"),
            "0.466563684509 0.249070228834 ");
}

TEST(Expression, StringFunctions) {
  EXPECT_EQ(
      said(
          "#debug concat(\"[\",str(3.14159,8,2),\"] [\",str(-3.5,-8,2),\"] [\",str(7,0,-1),\"]\")"),
      "[    3.14] [-0003.50] [7.000000]");
  EXPECT_EQ(said("#debug concat(vstr(5,<1,2>,\"/\",0,1),\" \",vstr(7,3,\"/\",0,1))"),
            "1.0/2.0/0.0/0.0/0.0 3.0/0.0/0.0/0.0/0.0");
  EXPECT_EQ(said("#debug concat(substr(\"Hello\",2,3),chr(65),strupr(\"aBc\"),strlwr(\"aBc\"),"
                 "str(asc(\"A\"),0,0),str(val(\"12.5e1x\"),0,1),str(strcmp(\"a\",\"b\"),0,0))"),
            "ellAABCabc65125.0-1");
  EXPECT_EQ(said("#debug concat(datetime(0),\"|\",datetime(5000.5,\"%Y-%m-%d %H:%M:%S\"))"),
            "2000-01-01 00:00:00Z|2013-09-09 12:00:00");
}

// POV-Ray 3.7's values.
TEST(Expression, CharactersOfStrings) {
  EXPECT_EQ(
      said("#macro C(A,B) concat(str(strcmp(A,B),0,0),\" \") #end #debug concat(C(\"ab\",\"abc\"),"
           "C(\"abc\",\"ab\"),C(\"\",\"z\"),C(\"\\u00e9\",\"a\"),C(\"aZ\",\"b\"),C(\"a\",\"a\"))"),
      "-99 99 -122 136 -1 0 ");
  EXPECT_EQ(
      said("#debug concat(str(strlen(\"\\u00e9x\"),0,0),\" \",substr(\"\\u20acxyz\",2,2),\" \","
           "str(asc(\"\\u20ac\"),0,0),\" \",str(strlen(chr(300)),0,0),\" \",str(asc(\"\"),0,0))"),
      "2 xy 8364 1 0");
}

TEST(Expression, WholeNumbersHaveNoNegativeZero) {
  EXPECT_EQ(said("#debug concat(str(int(-0.5),0,1),str(div(1,-3),0,1),str(ceil(-0.5),0,1))"),
            "0.00.0-0.0");
}

TEST(Expression, UAndVOfFunctionsAreXAndY) {
  EXPECT_EQ(said("#declare F = function(u,v) { x + 2*y } #declare G = function(x,y) { u + 2*v }"
                 "#debug concat(str(F(1,2),0,0), str(G(1,2),0,0))"),
            "55");
}

TEST(Expression, NumbersAreEqualWithinATolerance) {
  EXPECT_EQ(said("#debug concat(str((1e-10=0),0,0), str((1e-10!=0),0,0), str((1.1e-10=0),0,0))"),
            "100");
}

TEST(Expression, ComparisonsInFunctionsAreExact) {
  EXPECT_EQ(
      said("#declare F = function(x) { (x!=0) + 10*(x=0) + 100*(x<=0) + 1000*(0>=x) + 10000*(x&1) }"
           "#debug concat(str(F(1e-11),0,0),\" \",str(F(0),0,0),\" \",str(F(-1e-11),0,0))"),
      "10001 1110 11101");
}

TEST(Expression, CubicSplinesOfFewPointsStayInOnePlace) {
  EXPECT_EQ(said("#declare S = spline { cubic_spline 0, <0,0>, 1, <10,20> } #debug "
                 "vstr(2,S(0.2),\" \",0,0)"
                 "#declare T = spline { cubic_spline 0, <0,0>, 1, <10,20>, 2, <0,5> }"
                 "#debug concat(\" \",vstr(2,T(0.2),\" \",0,0))"),
            "5 10 10 20");
}

TEST(Expression, ComponentsMayBeInfinite) {
  EXPECT_EQ(said("#declare V = <1, pow(0, -1)>; #debug str(V.y,0,1)"), "inf");
}

TEST(Expression, WhereFunctionsAreNotDefined) {
  EXPECT_NE(said("#declare A = atan2(0, 0);").find("E0306"), std::string::npos);
  EXPECT_NE(said("#declare F = function(x) { min(x) }").find("E0318"), std::string::npos);
}

TEST(Expression, ColoursKeepWhatTheyAre) {
  EXPECT_EQ(said("#declare C=rgb<1,2,3>; #declare R=C.red; #debug str(R,0,1)"), "1.0");
  EXPECT_EQ(said("#declare C=color red .5 filter .25; #debug vstr(5,C,\",\",0,2)"),
            "0.50,0.00,0.00,0.25,0.00");
  EXPECT_EQ(said("#declare W=rgb 1; #declare C=W filter .5; #debug vstr(5,C,\",\",0,1)"),
            "1.0,1.0,1.0,0.5,0.0");
}

TEST(Expression, TheFrameIsThatOfTheOptions) {
  // What povray says for the second picture of +KI1 +KF2 +KFI2 +KFF4.
  EvaluateOptions options;
  options.frame = {1.5, 0.5, true, 1, 2, 3, 2, 4};
  EXPECT_EQ(said("#debug concat(str(clock,0,1),\" \",str(clock_delta,0,1),\" \",str(clock_on,0,0),"
                 "\" \",str(initial_clock,0,0),str(final_clock,0,0),str(frame_number,0,0),"
                 "str(initial_frame,0,0),str(final_frame,0,0))",
                 options),
            "1.5 0.5 1 12324");
}

TEST(Expression, StringsCompare) {
  EXPECT_EQ(said("#if(\"a\"<\"b\") #debug \"yes\" #end"), "yes");
  EXPECT_EQ(said("#declare S=\"b\"; #if(S=\"b\") #debug \"yes\" #end"), "yes");
}

TEST(Expression, ErrorsAreReportedOnce) {
  EXPECT_EQ(codes_of("#declare A = Nowhere*2+1; #declare B = A*2; sphere { B, A }"), "E0201");
  EXPECT_EQ(codes_of("#declare A = sqrt(-1);"), "E0306");
  EXPECT_EQ(codes_of("#declare A = ln(0);"), "E0306");
  EXPECT_EQ(codes_of("#declare A = <1,2>.z;"), "E0324");
  EXPECT_EQ(codes_of("#declare A = sin(<1,2,3>);"), "E0302");
  EXPECT_EQ(codes_of("#declare A = sin(1,2);"), "E0316");
  EXPECT_EQ(codes_of("#declare A = \"a\" + 1;"), "E0301");
}

TEST(Expression, DivisionByZeroIsHugeAndWarned) {
  EXPECT_NE(said("#declare A = 1/0; #if (A > 1e100) #debug \"huge\" #end").find("huge"),
            std::string::npos);
  EXPECT_EQ(codes_of("#declare A = 1/0;"), "");
  EXPECT_EQ(codes_of("#declare A = 1/0; sphere { 0, A }"), "E0303");
}

} // namespace
} // namespace abbe::lang
