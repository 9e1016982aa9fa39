// A crane of four joints, for tests of arms that are not a Panda.
#pragma once

namespace stampede::test {

// It turns at its foot, and bends at shoulder, elbow and wrist: shapes are boxes, so that no other file is needed.
inline constexpr const char* kCraneUrdf = R"(<robot name="crane">
  <link name="foot"><inertial><mass value="8"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <visual><origin xyz="0 0 0.2"/><geometry><box size="0.12 0.12 0.4"/></geometry></visual>
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.12 0.12 0.4"/></geometry></collision></link>
  <link name="mast"><inertial><mass value="2"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
  <link name="boom"><inertial><mass value="2"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial>
    <visual><origin xyz="0.15 0 0"/><geometry><box size="0.3 0.05 0.05"/></geometry></visual>
    <collision><origin xyz="0.15 0 0"/><geometry><box size="0.3 0.05 0.05"/></geometry></collision></link>
  <link name="forearm"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <visual><origin xyz="0.125 0 0"/><geometry><box size="0.25 0.05 0.05"/></geometry></visual></link>
  <link name="palm"><inertial><mass value="0.5"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial>
    <visual><geometry><box size="0.04 0.1 0.03"/></geometry></visual></link>
  <link name="left"><inertial><mass value="0.1"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial>
    <collision><origin xyz="0 0 -0.05"/><geometry><box size="0.02 0.01 0.06"/></geometry></collision></link>
  <link name="right"><inertial><mass value="0.1"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial>
    <collision><origin xyz="0 0 -0.05"/><geometry><box size="0.02 0.01 0.06"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="mast"/><origin xyz="0 0 0.4"/><axis xyz="0 0 1"/>
    <limit lower="-2.5" upper="2.5" velocity="2" effort="50"/></joint>
  <joint name="shoulder" type="revolute"><parent link="mast"/><child link="boom"/><axis xyz="0 1 0"/>
    <limit lower="-1.8" upper="0.8" velocity="2" effort="50"/></joint>
  <joint name="elbow" type="revolute"><parent link="boom"/><child link="forearm"/><origin xyz="0.3 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-2.6" upper="2.6" velocity="2" effort="30"/></joint>
  <joint name="wrist" type="revolute"><parent link="forearm"/><child link="palm"/><origin xyz="0.25 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" velocity="3" effort="10"/></joint>
  <joint name="left_slide" type="prismatic"><parent link="palm"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.03" velocity="0.2" effort="20"/></joint>
  <joint name="right_slide" type="prismatic"><parent link="palm"/><child link="right"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.03" velocity="0.2" effort="20"/></joint>
</robot>
)";

}  // namespace stampede::test
