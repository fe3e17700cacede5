// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <drawpoint/tests/house/sources.hpp>

// The front-door scripts without their long part: nothing here installs or builds. apt-get, dpkg-query, id
// and sudo are stand-ins in a folder at the head of the PATH that write down how they were called.

using namespace drawpoint::house;

namespace {

const std::filesystem::path root = DRAWPOINT_ROOT;

struct Answer {
  int code;
  std::string text;
};

Answer shell(const std::string& command) {
  Answer answer{-1, ""};
  FILE* pipe = popen(("exec 2>&1; " + command).c_str(), "r");
  if (!pipe) return answer;
  std::array<char, 4096> chunk{};
  while (const std::size_t n = std::fread(chunk.data(), 1, chunk.size(), pipe))
    answer.text.append(chunk.data(), n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

std::string quoted(const std::filesystem::path& path) {
  std::string text = "'";
  return text.append(path.string()).append("'");
}

Answer run_study(const std::string& arguments) { return shell(quoted(root / "run-study") + " " + arguments); }

class Machine : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "drawpoint-house-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    bin_ = name;
    program("dpkg-query", "exit 1");  // as dpkg-query does when it knows none of the packages
    program("npm", "exit 0");
    program("id", "echo 0");
  }
  void TearDown() override { std::filesystem::remove_all(bin_); }

  void program(const std::string& name, const std::string& body) {
    std::ofstream(bin_ / name) << "#!/bin/sh\necho \"" << name << " $*\" >> " << log().string() << "\n"
                               << body << "\n";
    std::filesystem::permissions(bin_ / name, std::filesystem::perms::owner_all);
  }
  std::filesystem::path log() const { return bin_ / "calls"; }
  std::string calls() const { return read_text(log()); }

  // Runs install_packages with the stand-ins in front.
  Answer install() const {
    return shell("PATH='" + bin_.string() + "':$PATH bash -c 'set -euo pipefail; root=\"" + root.string() +
                 "\"; source \"$root/cmake/prepare.sh\"; install_packages'");
  }

 private:
  std::filesystem::path bin_;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST(RunStudy, AnUnknownStudyIsRefusedWithTheList) {
  const Answer answer = run_study("no_such_study --runs 3");
  EXPECT_EQ(answer.code, 2) << answer.text;
  EXPECT_TRUE(has(answer.text, "there is no study \"no_such_study\"")) << answer.text;
  EXPECT_TRUE(has(answer.text, "lhd_loading")) << answer.text;
  EXPECT_TRUE(has(answer.text, "formula_demo")) << answer.text;
  EXPECT_TRUE(has(answer.text, "external_program")) << answer.text;
}

TEST(RunStudy, AnOptionBeforeTheNameKeepsItsValue) {
  const Answer answer = run_study("--json --runs 3 no_such_study");
  EXPECT_EQ(answer.code, 2) << answer.text;
  EXPECT_TRUE(has(answer.text, "there is no study \"no_such_study\"")) << answer.text;
}

TEST(RunStudy, HelpListsTheStudies) {
  const Answer answer = run_study("--help");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_TRUE(has(answer.text, "\n  lhd_loading\n")) << answer.text;
}

TEST_F(Machine, APreparedMachineInstallsNothing) {
  program("dpkg-query", "shift 3; for p in \"$@\"; do echo \"installed $p\"; done");
  program("apt-get", "exit 0");
  const Answer answer = install();
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_EQ(answer.text, "");
  EXPECT_FALSE(has(calls(), "apt-get")) << calls();
}

TEST_F(Machine, MissingPackagesAreNamedAndInstalled) {
  program("apt-get", "exit 0");
  const Answer answer = install();
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_TRUE(has(answer.text, "installing the Debian packages")) << answer.text;
  EXPECT_TRUE(has(answer.text, "libsimbody-dev")) << answer.text;
  EXPECT_TRUE(has(calls(), "coinor-libipopt-dev")) << calls();
  EXPECT_FALSE(has(calls(), " update")) << "the lists were good enough\n" << calls();
}

TEST_F(Machine, OnlyWhatIsMissingIsInstalled) {
  program("dpkg-query", "shift 3; for p in \"$@\"; do [ $p = libfcl-dev ] || echo \"installed $p\"; done");
  program("apt-get", "exit 0");
  const Answer answer = install();
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_TRUE(has(answer.text, "lacks: libfcl-dev\n")) << answer.text;
}

TEST_F(Machine, StalePackageListsAreFetchedOnce) {
  // Every call fails until the lists have been fetched.
  program("apt-get", "grep -q 'apt-get.* update' " + log().string());
  const Answer answer = install();
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_TRUE(has(answer.text, "fetching the package lists")) << answer.text;
}

TEST_F(Machine, AFailingAptStopsWithAReason) {
  program("apt-get", "echo 'E: no network' >&2; exit 100");
  const Answer answer = install();
  EXPECT_EQ(answer.code, 1) << answer.text;
  EXPECT_TRUE(has(answer.text, "E: no network")) << answer.text;
  EXPECT_TRUE(has(answer.text, "apt-get update failed")) << answer.text;
}

TEST_F(Machine, WithoutRootItGoesThroughSudoAndSaysSo) {
  program("id", "echo 1000");
  program("apt-get", "exit 0");
  program("sudo", "exec \"$@\"");
  const Answer answer = install();
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_TRUE(has(answer.text, "using sudo, for apt-get only")) << answer.text;
  EXPECT_TRUE(has(calls(), "sudo env DEBIAN_FRONTEND=noninteractive apt-get")) << calls();
}
