#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/pose3.h"

namespace lcmslam {

// The coordinate frames of a robot as tf knows them. A frame that is reported more than once keeps its first transform;
// one that differs by more than 1 mm or 1 mrad makes it a moving one. Transforms that are no poses are passed over.
class FrameTree {
 public:
  void Add(const std::string& parent, const std::string& child, const Pose3& T_parent_child);

  bool Contains(const std::string& frame) const;
  // "" at the root.
  std::string ParentOf(const std::string& frame) const;

  struct Mounting {
    Pose3 T_base_frame;
    std::vector<std::string> moving;  // joints on the way that move
  };
  // From the first transforms along the tree, up from both frames to where their ways meet. None where they do not.
  std::optional<Mounting> Find(const std::string& base, const std::string& frame) const;

 private:
  struct Joint {
    std::string parent;
    Pose3 T_parent_child;
    bool moves = false;
  };
  // frame, its parent, ... up to the root.
  std::vector<std::string> WayUp(const std::string& frame) const;

  std::map<std::string, Joint> joints_;  // by child
};

}  // namespace lcmslam
