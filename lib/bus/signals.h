#pragma once

namespace lcmslam {

// From now on SIGTERM and SIGINT set a flag; a second one ends the process as usual.
void CatchStopSignals();
bool StopRequested();

}  // namespace lcmslam
