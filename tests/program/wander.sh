# A policy for `stampede run --policy`: an action of each space in turn, whatever is seen.
turn=0
while read -r message; do
  case $message in *'"terminated":true'* | *'"truncated":true'*) continue ;; esac
  case $((turn % 9)) in
    0) action='"space": "joint_delta", "values": [0.02, 0.01, 0, -0.02, 0, 0.03, 0.05]' ;;
    1) action='"space": "tool_velocity", "values": [0.1, 0.05, -0.2, 0, 0.1, 0.3]' ;;
    2) action='"space": "tool_delta", "values": [0, 0.01, 0.005, 0.02, 0, 0], "frame": "tool"' ;;
    3) action='"space": "joint_velocity", "values": [0.3, -0.1, 0.2, 0, -0.4, 0, 0.5], "gripper": 0.02' ;;
    4) action='"space": "joint_torque", "values": [1, 0, -1, 0, 0.5, 0, 0.2]' ;;
    5) action='"space": "tool_path_delta", "values": [-0.03, 0.02, 0.04, 0, 0, 0.3]' ;;
    6) action='"space": "hold", "frames": 3' ;;
    7) action='"space": "gripper", "values": [0.01]' ;;
    8) action='"space": "release"' ;;
  esac
  if [ "$turn" -eq 90 ]; then action='"end": true'; fi
  turn=$((turn + 1))
  echo "{$action}"
done
