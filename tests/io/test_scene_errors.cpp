// SPDX-License-Identifier: BSD-3-Clause
// Mistakes in scenes: each is told with its place.
#include "scene_text.h"

#include <algorithm>
#include <tuple>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_scene_errors {

class SceneErrors : public SceneText {
protected:
  /** What follows the name of the scene in the error. */
  std::string
  errorOf(const std::string& text)
  {
    const std::string message = messageOf<IOError>([&] { load(text); });
    EXPECT_EQ(message.find(path_ + ":"), 0u) << text << " gives " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(!message.empty() && message.back() == '.') << message;
    return message.substr(std::min(message.size(), path_.size() + 1));
  }

  Message
  refusalOf(const std::string& text)
  {
    return thrownBy([&] { load(text); });
  }

  /** \param place of the error: line and column */
  void
  expectError(const std::string& text,
              const std::string& place,
              const std::string& code)
  {
    EXPECT_EQ(errorOf(text).find(place + ": "), 0u) << text;
    EXPECT_EQ(refusalOf(text).code, code) << text;
  }
};

TEST_F(SceneErrors, WordsThatAreNotKnownOrTooMany)
{
  expectError("spehre 0 0 0 1", "1:1", "unknown_word");
  expectError("Sphere 0 0 0 1", "1:1", "unknown_word");
  expectError("\n# c\n  sphere 0 0 0 1 colour 1", "3:18", "unknown_word");
  expectError("light lamp 0 0 1", "1:7", "unknown_word");
  expectError("shadows yes", "1:9", "unexpected_word");
  expectError("size 10 20 30", "1:12", "unexpected_word");
  expectError("background transparent 1", "1:24", "unexpected_word");
  expectError("include a.txt b.txt", "1:15", "unexpected_word");
  expectError("light point 0 0 1 radius 1 radius 2", "1:28", "repeated_part");
  expectError("cloud a.ply scale 2 fit 0 0 0 1", "1:21", "exclusive_words");
  expectError("cloud a.ply fit 0 0 0 1 at 0 0 0", "1:25", "exclusive_words");
  expectError("cloud a.ply delta 1 delta-abs 1", "1:21", "exclusive_words");
  expectError("cloud a.ply colormap gray", "1:1", "incomplete_entry");
  expectError("cloud a.ply color rgb range 0 1", "1:1", "incomplete_entry");
  expectError("cloud a.ply color x colormap jet", "1:30", "unknown_color_map");
  expectError("cloud a.ply color x colormap jet\xec", "1:30", "unknown_color_map");
}

TEST_F(SceneErrors, NumbersThatAreMissingMalformedOrOutOfRange)
{
  expectError("sphere 0 0 1", "1:13", "missing_word");
  expectError("sphere 0 0 1 # 2", "1:13", "missing_word");
  expectError("sphere 0 0 0 1 material", "1:24", "missing_word");
  expectError("size", "1:5", "missing_word");
  for (const char* const word :
       {"1.5m", "nan", "-inf", "INFINITY", "1e999", "0x10", "1,5", "--1", "x"})
    expectError("sphere 0 " + std::string(word) + " 0 1", "1:10", "unexpected_word");
  expectError("camera eye 1 0 0 at 1 x 0", "1:23", "unexpected_word");
  expectError("sphere 0 1e31 0 1", "1:10", "unexpected_word");
  for (const auto& [text, place, code] :
       std::vector<std::tuple<const char*, const char*, const char*>>{
           {"size 0 10", "1:6", "unexpected_word"},
           {"size 10 16385", "1:9", "unexpected_word"},
           {"size 10.5 1", "1:6", "unexpected_word"},
           {"depth -1", "1:7", "unexpected_word"},
           {"supersampling 9", "1:15", "unexpected_word"},
           {"light-samples 0", "1:15", "unexpected_word"},
           {"occlusion 4097", "1:11", "unexpected_word"},
           {"occlusion 1 distance 0", "1:22", "unexpected_word"},
           {"background 0 -1 0", "1:14", "unexpected_word"},
           {"background blue", "1:12", "unexpected_word"},
           {"sphere 0 0 0 0", "1:14", "unexpected_word"},
           {"plane 0 0 0 0 0 0", "1:13", "incomplete_entry"},
           {"plane 0 0 0 0 0 1 checker 0 1 1 1", "1:27", "unexpected_word"},
           {"light directional 0 0 0", "1:19", "incomplete_entry"},
           {"light point 0 0 0 radius -1", "1:26", "unexpected_word"},
           {"material m reflect 1.5", "1:20", "unexpected_word"},
           {"material m reflect 0.5 transparent 0.6", "1:10", "bright_material"},
           {"material m index 0", "1:18", "unexpected_word"},
           {"material m ambient -1", "1:20", "unexpected_word"},
           {"cloud a.ply fit 0 0 0 0", "1:23", "unexpected_word"},
           {"cloud a.ply turn 0 0 0 90", "1:18", "incomplete_entry"},
           {"cloud a.ply scale -1", "1:19", "unexpected_word"},
           {"cloud a.ply delta 0", "1:19", "unexpected_word"},
           {"cloud a.ply delta-abs 0", "1:23", "unexpected_word"},
           {"cloud a.ply lambda 2", "1:20", "unexpected_word"},
           {"cloud a.ply range 2 1", "1:21", "incomplete_entry"}})
    expectError(text, place, code);
}

TEST_F(SceneErrors, CamerasThatSeeNothing)
{
  expectError("camera eye 1 1 1 fov 20", "1:1", "incomplete_entry");
  expectError("camera eye 1 1 1 at 1 1 1", "1:1", "camera_without_sight");
  expectError("camera eye 0 0 1 at 0 0 0", "1:1", "camera_up_along_sight");
  expectError("camera eye 0 0 1 at 0 0 0 up 0 0 0", "1:30", "incomplete_entry");
  expectError("camera eye 1 0 0 at 0 0 0 fov 180", "1:31", "unexpected_word");
}

TEST_F(SceneErrors, MaterialsAreDefinedOnceAndBeforeTheirUse)
{
  expectError("sphere 0 0 0 1 material c\nmaterial c", "1:25", "unknown_word");
  expectError(
      "material a\nmaterial b\nsphere 0 0 0 1 material c", "3:25", "unknown_word");
  expectError("material a\nmaterial a", "2:10", "repeated_part");
}

TEST_F(SceneErrors, QuotesAndWhatIsNoText)
{
  expectError("cloud \"my file.ply", "1:7", "open_quote");
  expectError("cloud \"a\"b", "1:10", "text_behind_quote");
  expectError("cloud \"\"", "1:7", "missing_word");
  const std::string word(2000, 'a');
  const std::string error = errorOf("size 1 1\n" + word + " 1");
  EXPECT_EQ(error.find("2:1: "), 0u);
  EXPECT_EQ(wordOf(refusalOf("size 1 1\n" + word + " 1"), "word"),
            word.substr(0, 40) + "...");
  EXPECT_LT(error.size(), 300u);
  expectError("size 1 1\n" + std::string(20000, 'a'), "2:1", "too_many_parts");
  std::string umlauts;
  for (int i = 0; i < 40; ++i)
    umlauts += "\xC3\xA4";
  EXPECT_EQ("a" + umlauts.substr(0, 78) + "...",
            wordOf(refusalOf("a" + umlauts), "word"));
  for (const char* const text : {"size 1 1\n\x01", "sphere\n1\x1b[2J", "a\n\x0c"}) {
    const Message thrown = thrownBy([&] { load(text); });
    EXPECT_TRUE(thrown.code == "not_text_file" && numberOf(thrown, "line") == 2.0)
        << thrown;
  }
}

TEST_F(SceneErrors, FilesThatAreMissingOrGoRound)
{
  EXPECT_EQ(codeOf([&] { loadScene(folder_ / "no.txt", "", 1, report_); }),
            "no_such_file");
  EXPECT_EQ(errorOf("size 1 1\n cloud no.ply"),
            "2:2: Cannot read '" + (folder_ / "no.ply") + "': there is no such file.");
  EXPECT_EQ(errorOf("include no.txt"),
            "1:9: Cannot read '" + (folder_ / "no.txt") + "': there is no such file.");
  EXPECT_EQ(errorOf("include scene.txt"),
            "1:9: a file includes itself: " + path_ + " -> " + path_ + ".");
  const std::string other = folder_ / "other.txt";
  writeFile(other, "size 1 1\n\ninclude ./scene.txt");
  EXPECT_EQ(messageOf<IOError>([&] { load("include other.txt"); }),
            other + ":3:9: a file includes itself: " + path_ + " -> " + other + " -> " +
                (folder_ / "./scene.txt") + ".");
  writeFile(other, "sphere 0 0 0 1\ndepth x");
  const std::string message = messageOf<IOError>([&] { load("include other.txt"); });
  EXPECT_EQ(message.find(other + ":2:7: 'x' is not"), 0u) << message;
  EXPECT_EQ(codeOf([&] { load(""); }), "empty_file");
}

TEST_F(SceneErrors, ScenesThatDrawNothing)
{
  for (const char* const text : {"# nothing\n", "size 1 1\nlight point 0 0 1\n"})
    EXPECT_EQ(Message("empty_scene", {{"path", path_}}), refusalOf(text));
}

TEST_F(SceneErrors, CloudsThatCannotBeDrawn)
{
  writeFile(folder_ / "nan.csv", "x,y,z\nnan,0,0\nnan,1,0\n");
  expectError("size 1 1\n cloud nan.csv", "2:2", "cloud_without_finite_point");
  writeFile(folder_ / "bad.csv", splatTable("", {"!", "!"}));
  expectError("cloud bad.csv", "1:1", "cloud_without_usable_splats");
  writeFile(folder_ / "one.csv", splatTable(",value", {",1"}));
  expectError("cloud one.csv fit 0 0 0 1", "1:1", "cloud_without_extent");
  expectError("cloud one.csv scale 1e-30 scale 1", "1:27", "repeated_part");
  writeFile(folder_ / "two.csv", splatTable(",value", {",1", ",nan"}));
  expectError("cloud two.csv color q", "1:21", "unknown_field");
  expectError("cloud two.csv color rgb", "1:21", "cloud_without_colors");
  std::string tiny = splatTable("", {"", ""});
  tiny.replace(tiny.find("0.5"), 3, "1e-20");
  writeFile(folder_ / "tiny.csv", tiny);
  expectError("cloud tiny.csv scale 1e-30", "1:1", "splat_beyond_float");
}

} // namespace test_scene_errors
