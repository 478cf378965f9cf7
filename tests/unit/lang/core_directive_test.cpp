// SPDX-License-Identifier: MIT
// Directives, scopes, macros, arrays: sections 3 and 4 of the language notes ([T]: checked with
// povray).
#include "core_run.hpp"

#include <atomic>
#include <chrono>

namespace abbe::lang {
namespace {

TEST(Directive, ForIsInclusiveAndLeavesTheCounterPastTheEnd) {
  EXPECT_EQ(said("#for(N,1,3) #debug str(N,0,0) #end #debug str(N,0,0)"), "1234");
  EXPECT_EQ(said("#declare C=0; #for(I,0,3,0.3) #declare C=C+1; #end #debug str(C,0,0)"), "11");
  EXPECT_EQ(said("#for(N,3,1,-1) #debug str(N,0,0) #end"), "321");
  EXPECT_EQ(said("#for(N,1,9) #declare N=N+1; #debug str(N,0,0) #end"), "246810");
}

TEST(Directive, SwitchFallsThroughWithoutTesting) {
  std::string const text = "#switch(V) #case(1) #debug \"1\" #case(2) #debug \"2\" #range(5,9) "
                           "#debug \"r\" #break #else #debug \"e\" #end";
  EXPECT_EQ(said("#declare V=1;" + text), "12r");
  EXPECT_EQ(said("#declare V=2;" + text), "2r");
  EXPECT_EQ(said("#declare V=7;" + text), "r");
  EXPECT_EQ(said("#declare V=3;" + text), "e");
  EXPECT_EQ(said("#switch(1) #case(1) #debug \"1\" #else #debug \"e\" #end"), "1e");
}

TEST(Directive, BreakLeavesLoopsAndMacros) {
  EXPECT_EQ(said("#for(I,1,9) #if(I=3) #break #end #debug str(I,0,0) #end"), "12");
  EXPECT_EQ(said("#macro M() #debug \"a\" #if(1) #break #end #debug \"b\" #end M() #debug \"c\""),
            "ac");
  EXPECT_EQ(codes_of("#break"), "E0207");
}

TEST(Directive, ConditionsChooseOneBranch) {
  EXPECT_EQ(said("#if(0) #debug \"a\" #elseif(2) #debug \"b\" #else #debug \"c\" #end"), "b");
  EXPECT_EQ(said("#declare X1=1; #ifdef(X1) #debug \"d\" #end #ifndef(X2) #debug \"n\" #end"),
            "dn");
  EXPECT_EQ(
      said("#declare A=array[2]; #declare A[1]=3; #ifdef(A[1]) #debug \"1\" #end #ifdef(A[0]) "
           "#debug \"0\" #end"),
      "1");
}

TEST(Scope, DeclareOverwritesTheInnermostLocalShadows) {
  EXPECT_EQ(said("#declare A=1; #macro M() #local A=2; #declare A=3; #debug str(A,0,0) #end M() "
                 "#debug str(A,0,0)"),
            "31");
  EXPECT_EQ(said("#macro M() #declare B=7; #end M() #debug str(B,0,0)"), "7");
  EXPECT_EQ(codes_of("#macro M() #local B=7; #end M() #debug str(B,0,0)"), "E0201");
}

TEST(Macro, LoneNamesAreReferences) {
  EXPECT_EQ(said("#macro Set(P) #declare P=5; #end #declare A=1; Set(A) #debug str(A,0,0)"), "5");
  EXPECT_EQ(said("#macro Set(P) #declare P=5; #end #declare A=1; Set((A)) #debug str(A,0,0)"), "1");
  EXPECT_EQ(said("#macro Set(P) #declare P=5; #end #declare A=1; Set(A+0) #debug str(A,0,0)"), "1");
  EXPECT_EQ(said("#macro Set(P) #declare P=5; #end #declare A=array[2]{1,1} Set(A[1]) "
                 "#debug concat(str(A[0],0,0),str(A[1],0,0))"),
            "15");
}

TEST(Macro, YieldsValuesObjectsAndFragments) {
  EXPECT_EQ(said("#macro Twice(V) (V*2) #end #debug str(Twice(4)+1,0,0)"), "9");
  EXPECT_EQ(said("#macro Fact(N) #if(N<2) 1 #else N*Fact(N-1) #end #end #debug str(Fact(6),0,0)"),
            "720");
  EXPECT_EQ(codes_of("#macro Body() <0,0,0>, 1 pigment { color rgb 1 } #end sphere { Body() }"),
            "");
  EXPECT_EQ(
      codes_of("#macro Ball(X) sphere { X, 1 } #end union { Ball(0) #for(I,1,3) Ball(I) #end }"),
      "");
  EXPECT_EQ(codes_of("#macro P() pigment { color rgb 1 } #end sphere { 0, 1 P() }"), "");
}

TEST(Macro, ErrorsNameTheChainOfCalls) {
  std::string const out = said("#macro A() #declare V = Nothing; #end\n#macro B() A() #end\nB()");
  EXPECT_NE(out.find("test.scn:1:25-31: error[E0201]"), std::string::npos) << out;
  EXPECT_NE(out.find("test.scn:2:12-14: note: called from here: 'A'"), std::string::npos) << out;
  EXPECT_NE(out.find("test.scn:3:1-3: note: called from here: 'B'"), std::string::npos) << out;
  EXPECT_EQ(codes_of("#macro A(P) #end A()"), "E0308");
}

TEST(Macro, EndlessRecursionIsAnError) {
  EXPECT_EQ(codes_of("#macro A() A() #end A()"), "E0703");
  EXPECT_EQ(codes_of("#macro A() (1+A()) #end #declare X1=A();"), "E0703");
  EXPECT_EQ(codes_of("#macro A() union { A() } #end A()"), "E0703");
}

TEST(Array, ElementsHaveOneType) {
  EXPECT_EQ(
      said("#declare A=array[2][3]{{1,2,3},{4,5,6}} #debug concat(str(A[1][0],0,0),"
           "str(dimensions(A),0,0),str(dimension_size(A,2),0,0),str(dimension_size(A,3),0,0))"),
      "4230");
  EXPECT_EQ(codes_of("#declare A=array[2]; #declare A[0]=1; #declare A[1]=<1,2,3>;"), "E0312");
  EXPECT_EQ(codes_of("#declare A=array[2]; #declare B=A[1];"), "E0310");
  EXPECT_EQ(codes_of("#declare A=array[2]{1,2} #declare B=A[2];"), "E0311");
  EXPECT_EQ(codes_of("#declare A=array[2]{1}"), "E0314");
  EXPECT_EQ(codes_of("#declare A=array[1000000000];"), "E0705");
}

TEST(Array, CopiesAreDeepArgumentsAreNot) {
  EXPECT_EQ(said("#declare A=array[1]{1} #declare B=A; #declare B[0]=2; #debug str(A[0],0,0)"),
            "1");
  EXPECT_EQ(
      said("#macro M(P) #declare P[0]=9; #end #declare A=array[1]{1} M(A) #debug str(A[0],0,0)"),
      "9");
}

TEST(Directive, VersionIsReportedAsPovRayDoes) {
  EXPECT_EQ(said("#debug str(version,0,2) #version 3.5; #debug str(version,0,2)"), "3.703.50");
}

TEST(Directive, MissingSemicolonAfterANumber) {
  EXPECT_EQ(codes_of("#declare A = 1 #declare B = 2;"), "E0105");
  EXPECT_EQ(codes_of("#declare S = \"a\" #declare T1 = sphere { 0, 1 }"), "");
}

TEST(Directive, MessagesAndDiagnosticsComeInTheirOrder) {
  std::string const text = "#debug \"a\" #warning \"w\" #debug \"b\" #undef X #debug \"c\" ";
  auto const heard = [](std::string const& scene, std::size_t whole_text) {
    std::string out;
    EvaluateOptions options;
    options.whole_text = whole_text;
    options.text_piece = 8;
    options.on_message = [&](std::string_view message) { out += message; };
    options.on_diagnostic = [&](Diagnostic const& d) { out += "<" + d.code + d.message + ">"; };
    evaluate_text("test.scn", scene, options);
    return out;
  };
  std::string const all = "a<w>b<#undef: 'X' is not declared>c";
  EXPECT_EQ(heard(text, 1000), all);
  EXPECT_EQ(heard(text, 0), all);
  // A source with errors of syntax gives nothing but these, however it is read.
  EXPECT_EQ(heard(text + ")", 1000), heard(text + ")", 0));
  EXPECT_EQ(heard(text + ")", 0).substr(0, 6), "<E0112");
}

TEST(Directive, ErrorsEndTheLoopsThatWaitForWhatTheyDecide) {
  EXPECT_EQ(codes_of("#declare L=0; #while(L<3) #if(Q>0) #declare L=L+1; #end #end"), "E0201");
  EXPECT_EQ(codes_of("#declare L=0; #while(L<3) #switch(Q) #else #declare L=L+1; #end #end"),
            "E0201");
  EXPECT_EQ(codes_of("#for(I,0,Q) #error \"no\" #end"), "E0201");
  EXPECT_EQ(codes_of("#declare L=0; #macro Add(A,B) #declare L=L+1; #end #while(L<3) Add(1) #end"),
            "E0308 E0701");
}

TEST(Directive, ErrorEndsTheRun) {
  EXPECT_EQ(said("#debug \"a\" #error \"stop\" #debug \"b\"").substr(0, 1), "a");
}

TEST(Directive, StopFlagEndsAnEndlessLoop) {
  std::atomic<bool> stop{true};
  EvaluateOptions options;
  options.stop = &stop;
  auto const evaluated = evaluate_text("test.scn", "#while(1) #end", options);
  EXPECT_TRUE(evaluated.interrupted);
  EXPECT_FALSE(evaluated.ok());
}

TEST(Directive, ConditionalHeadsOpenOneBlock) {
  std::string const text = "#if(M) merge { #else union { #end sphere { 0, 1 } sphere { 1, 1 } }";
  auto const merged = evaluate_text("a.scn", "#declare M=1; " + text, {});
  auto const united = evaluate_text("a.scn", "#declare M=0; " + text, {});
  ASSERT_EQ(merged.scene.objects.size(), 1u);
  ASSERT_EQ(united.scene.objects.size(), 1u);
  EXPECT_EQ(merged.scene.objects[0].kind, scene::Object::Kind::Merge);
  EXPECT_EQ(united.scene.objects[0].kind, scene::Object::Kind::Union);
}

TEST(Files, CannotBeWrittenForThatReason) {
  EvaluateOptions options;
  options.allow_write = true;
  std::string const text = said("#fopen F \"no_such_folder/a.txt\" write #write(F, 1)", options);
  EXPECT_NE(text.find("E0504"), std::string::npos);
  EXPECT_NE(text.find("'no_such_folder/a.txt': No such file or directory"), std::string::npos)
      << text;
}

TEST(Files, WrittenFilesNeedPermissionUnlessReadBack) {
  EXPECT_EQ(codes_of("#fopen F \"core_test.tmp\" write #write(F, \"1\") #fclose F"), "E0503");
  EXPECT_EQ(
      said("#fopen F \"core_test.inc\" write #write(F, \"#declare A = \", 4, \";\") #fclose F "
           "#include \"core_test.inc\" #debug str(A,0,0)"),
      "4");
  EXPECT_EQ(
      said("#fopen F \"core_test.txt\" write #write(F, 1.5, \",\", <1,2,3>, \",\\\"txt\\\"\") "
           "#fclose F "
           "#fopen F \"core_test.txt\" read #read(F, A, B, C) #ifndef(F) #debug concat(str(A,0,1),"
           "vstr(3,B,\" \",0,0),C) #end"),
      "1.51 2 3txt");
  EXPECT_EQ(codes_of("#fopen F \"../../escape.txt\" write"), "E0503");
  EXPECT_EQ(codes_of("#fopen F \"/etc/passwd\" read"), "E0502");
  EXPECT_EQ(codes_of("#include \"no_such_file.inc\""), "E0501");
}

TEST(Function, ScalarFunctions) {
  EXPECT_EQ(
      said("#declare K=2; #declare F=function(x,y){x*K+y} #declare K=100; #debug str(F(3,1),0,0)"),
      "7");
  EXPECT_EQ(said("#declare F=function{1|1&0} #debug str(F(0,0,0),0,0)"), "1");
  EXPECT_EQ(said("#declare F=function(n){sum(i,1,n,i*i)} #debug str(F(4),0,0)"), "30");
  EXPECT_EQ(said("#declare F=function(n){prod(i,1,n,i)} #debug str(F(5),0,0)"), "120");
  EXPECT_EQ(said("#declare N=function{internal(76)} #debug str(N(.3,.7,1.9),0,12)"),
            "0.367178081198");
  EXPECT_EQ(codes_of("#declare F=function(a){a} #declare F=function(a){2*a}"), "E0205");
}

TEST(Spline, InterpolatesByItsType) {
  std::string const points = "0,<0,0,0> 1,<1,2,0> 2,<2,0,0> 3,<3,2,0> }";
  EXPECT_EQ(said("#declare S=spline { cubic_spline " + points + " #debug vstr(3,S(1.5),\",\",0,3)"),
            "1.500,1.000,0.000");
  EXPECT_EQ(said("#declare S=spline { " + points + " #debug vstr(3,S(.25),\",\",0,3)"),
            "0.250,0.500,0.000");
}

TEST(Speed, TenMillionRoundsTakeSeconds) {
  auto const start = std::chrono::steady_clock::now();
  EXPECT_EQ(said("#declare I=0; #while(I<1000000) #declare I=I+1; #end #debug str(I,0,0)"),
            "1000000");
  double const seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  // Measured: 0.1 s for a million; the bound only catches a loss of an order of magnitude.
  EXPECT_LT(seconds, 2);
}

} // namespace
} // namespace abbe::lang
