"""Hand-eye calibration of ROS bags by the program handeye."""
