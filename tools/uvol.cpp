// SPDX-License-Identifier: BSD-3-Clause
// One name for all tools: uvol isosurface in.csv out.ply ... is uvol_isosurface with
// the same arguments. The tools are those that lie beside it.
#include "common/printable.h"
#include "common/similar_words.h"
#include "io/folder.h"
#include "io/formats.h"
#include "shared/options.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <unistd.h>

namespace {

using uvol_tools::UsageError;

const std::string prefix = "uvol_";

std::filesystem::path
findFolder()
{
  return std::filesystem::canonical("/proc/self/exe").parent_path();
}

/** Names of the tools, without what is common to all of them. */
std::vector<std::string>
listTools()
{
  std::vector<std::string> names;
  const std::filesystem::path folder = findFolder();
  for (const std::string& name : pcl_uvol::io::listFolder(folder.string()))
    if (name.compare(0, prefix.size(), prefix) == 0 &&
        access((folder / name).c_str(), X_OK) == 0 &&
        name.find('.') == std::string::npos)
      names.push_back(name.substr(prefix.size()));
  std::sort(names.begin(), names.end());
  return names;
}

std::string
findTool(const std::string& name)
{
  const std::vector<std::string> names = listTools();
  if (std::find(names.begin(), names.end(), name) != names.end())
    return (findFolder() / (prefix + name)).string();
  const std::string similar = pcl_uvol::findSimilar(names, name);
  throw UsageError("There is no tool " + pcl_uvol::quoteText(name) +
                   (similar.empty() ? "." : "; did you mean " + similar + "?"));
}

/** The first sentence of what a tool says about itself. */
std::string
readPurpose(const std::string& tool)
{
  std::string command = "'";
  for (const char c : tool)
    command += c == '\'' ? std::string("'\\''") : std::string(1, c);
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
      popen((command + "' -h").c_str(), "r"), pclose);
  if (!pipe)
    return "";
  std::array<char, 1024> block{};
  const std::size_t count = std::fread(block.data(), 1, block.size(), pipe.get());
  std::string text(block.data(), count);
  while (std::fread(block.data(), 1, block.size(), pipe.get()) > 0)
    ; // a tool whose words nobody takes ends with an error
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, text.find(". ") + 1);
}

void
printTools()
{
  std::cout
      << "Run the tools of pcl_uvol, which extract surfaces from scattered "
         "samples.\n\nUsage:\n"
         "  uvol TOOL [arguments]  uvol isosurface star.csv star.ply -iso 0.1 is\n"
         "                         uvol_isosurface star.csv star.ply -iso 0.1\n"
         "  uvol TOOL -h           explains a tool, -h all with every option\n"
         "  uvol --list-formats    lists the formats that are read and written\n"
         "  uvol --version         prints the version\n\nTools:\n";
  for (const std::string& name : listTools())
    std::cout << "  " << name
              << std::string(16 - std::min<std::size_t>(15, name.size()), ' ')
              << readPurpose(findTool(name)) << '\n';
}

std::string
joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : " ") + word;
  return text;
}

void
printFormats()
{
  using pcl_uvol::io::listLoadedEndings;
  using pcl_uvol::io::listSavedEndings;
  std::cout
      << "Points, read:    " << joined(listLoadedEndings())
      << ", snapshots of Gadget;\n                 packed .gz .bz2 .xz .zst; - is "
         "standard input"
      << "\nPoints, written: " << joined(listSavedEndings())
      << ", by many processes .pvtp\n"
         "Meshes, read:    .ply .vtp .vtkhdf .obj .off .stl\n"
         "Meshes, written: .ply .vtp .vtkhdf .obj .off .stl\n"
         "Volumes, read:   .nrrd .nhdr .vti .mha .mhd .vtk (structured points)\n"
         "Grids, written:  .vti, of uvol_probe also .vts .nrrd .mha\n"
         "Scenes, read:    .scene .txt\n"
         "Pictures:        .png, .svg, .pdf; of uvol_render also .html, which turns in "
         "any browser\n";
}

/** \throws UsageError unless the process becomes the tool */
[[noreturn]] void
become(const std::string& name, char** arguments)
{
  const std::string tool = findTool(name);
  std::string title = prefix + name;
  arguments[0] = title.data();
  execv(tool.c_str(), arguments);
  throw pcl_uvol::Exception("tool_not_started",
                            {{"path", tool}, {"reason", std::strerror(errno)}});
}

int
run(int argc, char** argv)
{
  const std::string word = argc > 1 ? argv[1] : "-h";
  if (word == "--list-formats" || word == "-list-formats")
    printFormats();
  else if (word == "-version" || word == "--version")
    std::cout << "uvol of pcl_uvol " << PCL_UVOL_VERSION << '\n';
  else if (word == "help" && argc > 2) {
    std::array<char*, 3> arguments{argv[0], const_cast<char*>("-h"), nullptr};
    become(argv[2], arguments.data());
  }
  else if (word == "-h" || word == "--help" || word == "help")
    printTools();
  else
    become(word, argv + 1);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol", [&] { return run(argc, argv); });
}
