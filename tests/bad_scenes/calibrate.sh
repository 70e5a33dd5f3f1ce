# What a calibration refuses before anything is written. Each line changes one thing of a scene that is all right.
cp "$here/calibrate.prm" .
bad() { debond calibrate.prm "$@"; }
bad --set "Interface/Friction coefficient broken=0.5"
bad --set "Interface/Friction coefficient broken=<<0.5 in 0.1..1e7>>"
bad --set "Interface/Friction coefficient broken=<<0.5>>" --set "Task=simulate"
bad --set "Output/Reference curve="
bad --set "Output/Reference curve=files/none.csv"
bad --set "Output/Reference columns=1, 3"
bad --set "Output/Directory={{a|b}}"
bad --set "Calibration/Curves=torque"
bad --set "Calibration/Curves=torque_Nmm, chuck_Fz_N"
bad --set "Calibration/Over=radius"
bad --set "Calibration/Over=time"
bad --set "Calibration/Windows=20, 30"
bad --set "Calibration/Windows=1"
bad --set "Calibration/Noise=0.01, 0.02"
bad --set "Calibration/Noise columns=torque_Nmm, angle_deg"
bad --set "Calibration/Noise columns=9"
bad --set "Model=auto"
bad --set "Output/Reference curve=" --set "Calibration/Over=chuck_Mz_Nmm"
bad --set "Calibration/Starts=0"
rm calibrate.prm
