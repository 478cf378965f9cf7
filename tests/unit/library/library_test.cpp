// SPDX-License-Identifier: MIT
#include <abbe.hpp>

#include <gmock/gmock.h>

namespace abbe {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

PictureOptions small(int width, int height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  options.stdlib = ABBE_STDLIB_DIR;
  return options;
}

/// A plane that glows in one colour fills the picture with it; rows come from the top.
TEST(Library, RendersATextIntoAnArray) {
  auto const picture =
      render_text("global_settings { assumed_gamma 1 }\n"
                  "camera { orthographic location <0, 0, -5> look_at 0 right 2 * x up 2 * y }\n"
                  "#default { finish { ambient 0 diffuse 0 emission 1 } }\n"
                  "box { <-9, 0, 0>, <9, 9, 1> pigment { rgb <.25, .5, 2> } }\n"
                  "box { <-9, -9, 0>, <9, 0, 1> pigment { rgb <1, 0, K> } }\n",
                  [] {
                    auto options = small(1, 2);
                    options.declarations = {{"K", "0.75"}};
                    return options;
                  }());
  ASSERT_TRUE(picture.ok());
  EXPECT_EQ(picture.width, 1);
  EXPECT_EQ(picture.height, 2);
  EXPECT_THAT(picture.rgb, ElementsAre(.25F, .5F, 2.F, 1.F, 0.F, .75F));
  EXPECT_TRUE(picture.messages.empty());
}

TEST(Library, TellsWhatIsWrongAndWhere) {
  auto const picture = render_text("#debug \"so far\\n\"\nsphere { 0 }\n", small(4, 4), "mine");
  EXPECT_EQ(picture.end, Picture::End::SceneIsWrong);
  EXPECT_TRUE(picture.rgb.empty());
  EXPECT_THAT(picture.messages, Contains(Field(&Message::text, "so far\n")));
  auto const& error = picture.messages.back();
  EXPECT_EQ(error.kind, Message::Kind::Error);
  EXPECT_EQ(error.file, "mine");
  EXPECT_EQ(error.line, 2);
  EXPECT_FALSE(error.code.empty());
}

TEST(Library, AMissingFileIsUnreadable) {
  auto const picture = render_file("no such scene.scn", small(4, 4));
  EXPECT_EQ(picture.end, Picture::End::Unreadable);
  EXPECT_FALSE(picture.messages.empty());
}

TEST(Library, OptionsAreChecked) {
  auto options = small(0, 4);
  auto const picture = render_text("", options);
  EXPECT_EQ(picture.end, Picture::End::SceneIsWrong);
  ASSERT_EQ(picture.messages.size(), 1u);
  EXPECT_THAT(picture.messages[0].text, HasSubstr("pixels across"));
}

TEST(Library, EndsWhenItIsTold) {
  std::atomic<bool> const stop{true};
  auto options = small(4, 4);
  options.stop = &stop;
  auto const picture = render_text("sphere { 0, 1 }", options);
  EXPECT_EQ(picture.end, Picture::End::Interrupted);
  EXPECT_TRUE(picture.rgb.empty());
}

/// The standard library is found where PictureOptions says.
TEST(Library, KnowsItsGlasses) {
  auto const picture =
      render_text("sphere { 0, 1 interior { glass { \"SCHOTT/N-BK7\" } } }", small(2, 2));
  EXPECT_TRUE(picture.ok());
}

} // namespace
} // namespace abbe
