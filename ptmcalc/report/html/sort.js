(function () {
  "use strict";
  var table = document.getElementById("files"), body = table.tBodies[0];
  var heads = Array.prototype.slice.call(table.tHead.rows[0].cells);
  function key(row, column) {
    var cell = row.cells[column];
    return cell.hasAttribute("data-sort") ? cell.getAttribute("data-sort") : cell.textContent.trim();
  }
  function compare(one, other) {
    if (one === other) { return 0; }
    if (one === "" || other === "") { return one === "" ? 1 : -1; }
    var both = [Number(one), Number(other)];
    return isNaN(both[0]) || isNaN(both[1]) ? one.localeCompare(other) : both[0] - both[1];
  }
  heads.forEach(function (head, column) {
    var button = document.createElement("button");
    button.type = "button";
    button.textContent = head.textContent;
    head.textContent = "";
    head.appendChild(button);
    button.addEventListener("click", function () {
      var down = head.getAttribute("aria-sort") === "ascending";
      heads.forEach(function (other) { other.removeAttribute("aria-sort"); });
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      Array.prototype.slice.call(body.rows).map(function (row) { return [key(row, column), row]; })
        .sort(function (a, b) {
          if (a[0] === "" || b[0] === "") { return compare(a[0], b[0]); }
          return (down ? -1 : 1) * compare(a[0], b[0]);
        })
        .forEach(function (pair) { body.appendChild(pair[1]); });
    });
  });
})();
