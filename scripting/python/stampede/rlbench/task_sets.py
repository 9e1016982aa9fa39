"""RLBench's task sets: FS10_V1 … FS95_V1, of tasks to train and to test on, and MT15_V1 … MT100_V1."""

from __future__ import annotations

from collections.abc import Collection, Sequence

# Each set of FS… has the tasks of the one before it, and trains on these and tests on those as well.
_STAGES = {
    10: (
        "reach_target close_box close_microwave plug_charger_in_power_supply toilet_seat_down "
        "take_umbrella_out_of_umbrella_stand put_umbrella_in_umbrella_stand slide_cabinet_open close_fridge "
        "pick_and_lift",
        "open_box open_microwave unplug_charger toilet_seat_up open_fridge",
    ),
    25: (
        "turn_tap light_bulb_in basketball_in_hoop open_window close_door push_button put_item_in_drawer open_drawer "
        "close_drawer turn_oven_on",
        "light_bulb_out tv_on open_oven open_door take_item_out_of_drawer",
    ),
    50: (
        "beat_the_buzz block_pyramid change_clock close_jar close_laptop_lid empty_container empty_dishwasher "
        "get_ice_from_fridge hang_frame_on_hanger insert_onto_square_peg put_rubbish_in_bin put_shoes_in_box "
        "put_toilet_roll_on_stand put_tray_in_oven reach_and_drag remove_cups scoop_with_spatula set_the_table "
        "setup_checkers slide_block_to_target",
        "hockey insert_usb_in_computer press_switch play_jenga meat_off_grill",
    ),
    95: (
        "hit_ball_with_queue screw_nail lamp_off lamp_on meat_on_grill move_hanger open_jar open_wine_bottle place_cups "
        "place_hanger_on_rack place_shape_in_shape_sorter put_bottle_in_fridge put_knife_in_knife_block "
        "put_money_in_safe put_plate_in_colored_dish_rack slide_cabinet_open_and_place_cups stack_blocks stack_cups "
        "stack_wine straighten_rope sweep_to_dustpan take_cup_out_from_cabinet take_frame_off_hanger "
        "take_lid_off_saucepan take_money_out_safe take_off_weighing_scales take_plate_off_colored_dish_rack "
        "take_shoes_out_of_box take_toilet_roll_off_stand take_usb_out_of_computer water_plants weighing_scales "
        "wipe_desk change_channel open_grill close_grill solve_puzzle pick_up_cup phone_on_base pour_from_cup_to_cup",
        "put_knife_on_chopping_board put_books_on_bookshelf push_buttons put_groceries_in_cupboard take_tray_out_of_oven",
    ),
}
_JOINT = {10: "MT15_V1", 25: "MT30_V1", 50: "MT55_V1", 95: "MT100_V1"}  # both halves of a set, to train on

SET_NAMES = (*(f"FS{size}_V1" for size in _STAGES), *_JOINT.values())


def task_sets(known: Collection[str]) -> dict[str, dict[str, list[str]]]:
    """
    Names of the tasks of each set. known: tasks that there are.

    A task that RLBench has and we have not is replaced by one that is in no set, or is trained on in the last alone; so the largest
    sets are smaller than their names say as long as there are fewer than a hundred tasks.
    """
    listed = {task for stage in _STAGES.values() for half in stage for task in half.split()}
    late, _ = list(_STAGES.values())[-1]
    spare = sorted(set(known) - listed) + sorted(set(known) & set(late.split()))
    used: set[str] = set()

    def there(wanted: Sequence[str]) -> list[str]:
        chosen = []
        for task in wanted:
            if task not in known or task in used:
                task = next((one for one in spare if one not in used and one not in wanted), "")
            if task:
                used.add(task)
                chosen.append(task)
        return chosen

    sets: dict[str, dict[str, list[str]]] = {}
    before: list[str] = []
    for size, (train, test) in _STAGES.items():
        train_added, test_tasks = there(train.split()), there(test.split())
        sets[f"FS{size}_V1"] = {"train": before + train_added, "test": test_tasks}
        before = before + train_added + test_tasks
        sets[_JOINT[size]] = {"train": before}
    return sets
