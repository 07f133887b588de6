"""The first screen: a sentence for each question, and the scoreboard."""
