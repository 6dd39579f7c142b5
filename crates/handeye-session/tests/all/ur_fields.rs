//! Fields of RTDE that programs ask for, with their types.

/// The type of a field, as the guide to RTDE has it; of those that programs ask for.
pub fn type_of(name: &str) -> &'static str {
    match name {
        "joint_mode" => "VECTOR6INT32",
        "actual_tool_accelerometer" | "elbow_position" | "elbow_velocity" | "payload_cog" => {
            "VECTOR3D"
        }
        "robot_mode" | "safety_mode" | "tool_output_voltage" => "INT32",
        "actual_digital_input_bits" | "actual_digital_output_bits" => "UINT64",
        "robot_status_bits" | "safety_status_bits" | "runtime_state" | "safety_status" => "UINT32",
        name if DOUBLES.contains(&name) => "DOUBLE",
        name if name.starts_with("standard_analog_") => "DOUBLE",
        name if name.starts_with("output_bit_registers") => "UINT32",
        name if name.starts_with("output_int_register") => "INT32",
        name if name.starts_with("output_double_register") => "DOUBLE",
        name if SIXES.contains(&name) => "VECTOR6D",
        _ => "NOT_FOUND",
    }
}

const DOUBLES: [&str; 10] = [
    "timestamp",
    "actual_execution_time",
    "actual_main_voltage",
    "actual_momentum",
    "actual_robot_current",
    "actual_robot_voltage",
    "payload",
    "speed_scaling",
    "target_speed_fraction",
    "tcp_force_scalar",
];

const SIXES: [&str; 21] = [
    "actual_q",
    "actual_qd",
    "actual_TCP_pose",
    "actual_TCP_speed",
    "actual_TCP_force",
    "actual_current",
    "actual_current_as_torque",
    "actual_joint_voltage",
    "ft_raw_wrench",
    "joint_control_output",
    "joint_temperatures",
    "payload_inertia",
    "target_q",
    "target_qd",
    "target_qdd",
    "target_current",
    "target_moment",
    "target_TCP_pose",
    "target_TCP_speed",
    "tcp_offset",
    "wrench_calc_from_currents",
];

/// Its bytes.
pub fn size_of_type(kind: &str) -> usize {
    match kind {
        "VECTOR6D" => 48,
        "VECTOR3D" | "VECTOR6INT32" => 24,
        "DOUBLE" | "UINT64" => 8,
        "INT32" | "UINT32" => 4,
        _ => 0,
    }
}
