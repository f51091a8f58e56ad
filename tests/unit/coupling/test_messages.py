"""What participants say is kept, the newest of it, and told to who listens."""

from cosim.coupling import Message, Messages


def test_messages_are_kept_with_their_time_in_one_line():
    messages, heard = Messages("motor"), []
    messages.listeners.append(heard.append)
    messages.add("warning", "", "two\n lines")
    messages.time = 0.5
    messages.add("error", "heat", "")
    assert (
        heard
        == list(messages)
        == [
            Message("motor", None, "warning", "", "two lines"),
            Message("motor", 0.5, "error", "heat", ""),
        ]
    )
    assert str(heard[1]) == "motor: t = 0.5 s: error [heat]: "


def test_the_newest_are_kept_and_the_others_counted():
    messages = Messages("motor", kept=3)
    for number in range(10):
        messages.add("ok", "", str(number))
    assert [message.text for message in messages] == ["7", "8", "9"]
    assert (len(messages), messages.dropped) == (3, 7)
