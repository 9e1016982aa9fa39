"""A policy for `stampede run --policy`: plays joint positions back, a line of a CSV file a frame."""

import json
import sys

rows = [[float(word) for word in line.split(",")] for line in open(sys.argv[1], encoding="ascii")]
left = iter(rows)
for line in sys.stdin:
    message = json.loads(line)
    if message["type"] == "reset":
        left = iter(rows)
    elif message["terminated"] or message["truncated"]:
        continue
    row = next(left, None)
    print(json.dumps({"end": True} if row is None else {"space": "joint_position", "values": row}), flush=True)
