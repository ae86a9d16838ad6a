#include "common/run_service.h"
#include "ground-truth-logger/ground_truth_logger.h"
#include "ground-truth-logger/ground_truth_logger.pb.h"

int main(int argc, char** argv) {
  return lcmslam::RunService<lcmslam::GroundTruthLogger>(argc, argv, "Records ground truth poses from the bus");
}
