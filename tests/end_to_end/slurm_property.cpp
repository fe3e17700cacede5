// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study whose runs are tasks on a Slurm cluster, a real one on the loopback device: it gives what it gives
/// on one machine, bit for bit, also when its driver is killed and a node is lost.

#include <drawpoint/tests/end_to_end/support.hpp>
#include <drawpoint/tests/support/slurm_cluster.hpp>

#include <memory>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study =
    "env TROUBLE=large " TROUBLED_STUDY " --runs 12 --validation 4 --adaptive 4 --batch 4";
const std::string slow = "env TROUBLE=slow " TROUBLED_STUDY " --runs 12 --validation 4 --slurm";
const char* const rows =
    "SELECT group_concat(kind || quote(x) || quote(y) || seed || status || quote(cost) || quote(wear) || "
    "log) FROM runs";

class Slurm : public StudyTest {
 protected:
  Slurm() { cluster_ = std::make_unique<support::SlurmCluster>(place_ / "cluster", 2); }
  ~Slurm() override { cluster_.reset(); }

  std::unique_ptr<support::SlurmCluster> cluster_;
};

TEST_F(Slurm, ResultsAreThoseOfOneMachineBitForBit) {
  ASSERT_EQ(run(study + out()).code, 0);
  const std::string here = query(rows);
  std::filesystem::remove_all(dir());
  const Ended end = run(study + out() + " --slurm --slurm-option=--partition=all --jobs 3");
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(contains(end.out, "16 runs go to Slurm"));
  EXPECT_EQ(query(rows), here);
  EXPECT_TRUE(std::filesystem::exists(dir() / "logs" / "run_0020.h5"));
  EXPECT_FALSE(std::filesystem::exists(dir() / "slurm"));
  const Ended more = run("env TROUBLE=large " TROUBLED_STUDY " --runs 14 --slurm" + out());
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_TRUE(contains(more.out, "again on the cluster, to see that the simulator is the same"));
  EXPECT_TRUE(contains(more.out, "as stored, bit for bit"));
  EXPECT_FALSE(std::filesystem::exists(dir() / "slurm_check"));
}

TEST_F(Slurm, ADeadDriverAndALostNodeCostNoRun) {
  ASSERT_EQ(run("env TROUBLE=slow " TROUBLED_STUDY " --runs 12 --validation 4" + out()).code, 0);
  const std::string here = query(rows);
  std::filesystem::remove_all(dir());
  {
    Command driver(slow + out(), place_);
    await_done(2);
    driver.send(SIGKILL);
    driver.wait();
  }
  cluster_->lose(2);
  const Ended rest = run(slow + out() + " --json");
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(rest.json()["failed"], 0);
  EXPECT_EQ(query(rows), here);
}

TEST_F(Slurm, CtrlCLeavesTheTasksAndSaysWhatBecomesOfThem) {
  Command driver(slow + out(), place_);
  await_done(1);
  driver.send(SIGINT);
  const Ended stopped = driver.wait();
  EXPECT_EQ(stopped.code, 130);
  EXPECT_TRUE(contains(stopped.err, "the tasks that Slurm has go on, and the same command takes them over"));
  EXPECT_EQ(count("status = 'running'"), 0);
  const Ended elsewhere = run("env TROUBLE=slow " TROUBLED_STUDY + out());
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_TRUE(contains(elsewhere.err, "are with Slurm (drawpoint-"));
  cluster_->await([&] { return cluster_->tasks() == 0; });
  const Ended rest = run(slow + out());
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(count("status = 'done'"), 16);
}

TEST_F(Slurm, WhatSlurmRefusesIsSaidWithItsWords) {
  const Ended refused = run(slow + out() + " --slurm-option=--partition=moon");
  EXPECT_EQ(refused.code, 1);
  EXPECT_TRUE(contains(refused.err, "Slurm takes no job: sbatch ended with exit code 1"));
  EXPECT_TRUE(contains(refused.err, "invalid partition specified: moon"));
  cluster_.reset();
  EXPECT_TRUE(contains(run(slow + out()).err, "there is no Slurm cluster here"));
}

}  // namespace
