"""From the table of a sweep to a plot: friction over the angle of the grooves."""

import pandas as pd

table = pd.read_csv("sweep/sweep.csv")
normal = table["reaction.floor.z"].abs()
table["drag"] = table["reaction.floor.x"].abs() / normal
table["sideways"] = table["reaction.floor.y"].abs() / normal
print(table[["turn", "status", "drag", "sideways"]])
plot = table.plot(x="turn", y=["drag", "sideways"], marker="o", grid=True)
plot.set(xlabel="angle of the grooves (degrees)", ylabel="force over normal force")
plot.figure.savefig("sweep.png", dpi=110)
