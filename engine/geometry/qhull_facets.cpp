// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/qhull_facets.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace drawpoint::engine::detail {
namespace {

// What Qhull has to say, which it says to a file.
class Words {
 public:
  Words() : file_(open_memstream(&text_, &size_)) {
    if (!file_) throw std::runtime_error("engine::ConvexPolyhedron: no memory for Qhull's messages");
  }
  ~Words() {
    std::fclose(file_);
    std::free(text_);
  }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  std::FILE* file() const { return file_; }
  std::string first_line() {
    std::fflush(file_);
    const std::string said(text_, size_);
    return said.substr(0, said.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

class Qhull {
 public:
  explicit Qhull(std::span<const Eigen::Vector3d> points) {
    for (const Eigen::Vector3d& p : points) numbers_.insert(numbers_.end(), p.begin(), p.end());
    qh_zero(qh_, words_.file());
    char command[] = "qhull Pp";  // without warnings of narrow hulls
    const int code = qh_new_qhull(qh_, 3, static_cast<int>(points.size()), numbers_.data(), False, command,
                                  nullptr, words_.file());
    if (code == 0) return;
    const std::string why = words_.first_line();
    release();
    throw std::invalid_argument(why);
  }
  ~Qhull() { release(); }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  std::vector<std::vector<int>> facets() {
    std::vector<std::vector<int>> result;
    for (facetT* facet = qh_->facet_list; facet && facet->next; facet = facet->next) {
      setT* corners = qh_facet3vertex(qh_, facet);
      std::vector<int>& face = result.emplace_back();
      for (void** at = &corners->e[0].p; *at; ++at)
        face.push_back(qh_pointid(qh_, static_cast<vertexT*>(*at)->point));
      std::reverse(face.begin(), face.end());  // qh_facet3vertex() goes round clockwise
      qh_settempfree(qh_, &corners);
    }
    return result;
  }

 private:
  void release() {
    qh_freeqhull(qh_, !qh_ALL);
    int memory = 0, blocks = 0;
    qh_memfreeshort(qh_, &memory, &blocks);
  }

  Words words_;
  std::vector<double> numbers_;
  std::unique_ptr<qhT> state_ = std::make_unique<qhT>();  // large
  qhT* qh_ = state_.get();
};

}  // namespace

std::vector<std::vector<int>> qhull_facets(std::span<const Eigen::Vector3d> points) {
  return Qhull(points).facets();
}

}  // namespace drawpoint::engine::detail
